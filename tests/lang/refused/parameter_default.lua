local x = param("scale", math.sin)
function height(p) return p.x end
-- error: 1:26 parameter-default
