local x = param("scale", 5, { min = 10, max = 20 })
function height(p) return p.x end
-- error: 1:26 parameter-range
