local n = 1
local a = param(n, 1)
local b = param("b")
function height(p) return p.x end
-- error: 2:17 parameter-name
-- error: 3:11 missing-argument
