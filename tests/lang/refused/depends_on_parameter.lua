-- which function a name stands for may not depend on a parameter
local soft = param("soft", true)
local function smooth(x) return smoothstep(0, 1, x) end
local function hard(x) return step(0.5, x) end
local chosen = soft and smooth or hard
local later
if soft then later = smooth else later = hard end
function height(p)
  return chosen(p.x) + later(p.y)
end
-- error: 5:16 depends-on-parameter
-- error: 7:14 depends-on-parameter
-- error: 7:34 depends-on-parameter
