local a = param("scale", 1)
local b = param("scale", 2)
function height(p) return p.x end
-- error: 2:17 parameter-twice
