local total = 0
local function add(k) total = total + k end
for k = 1, 6 do add(k) end
function height(p) return total end
-- error: 2:23 not-available-yet
