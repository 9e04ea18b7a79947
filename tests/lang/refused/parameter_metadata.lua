local x = param("scale", 5, { minimum = 10 })
local y = param("size", 5, { doc = 3 })
function height(p) return p.x end
-- error: 1:31 parameter-metadata
-- error: 2:36 parameter-metadata
