-- Shadowing, blocks, and names that the library has too.
local x = 1.0
function shadows(time)
  local a = x
  local x = time
  do
    local x = x * 2
    a = a + x
  end
  return a, x
end
-- run: shadows time=3
-- expect: 7, 3

function names(p)
  local floor, min, noise = p.x, p.y, p.z
  return floor + min * noise
end
-- run: names p=1,2,3
-- expect: 7

local function mix(a, b) return a * 10 + b end
function own_mix(time) return mix(time, 1) end
-- run: own_mix time=2
-- expect: 21

function redeclared(time)
  local y = time
  local y = y + 1
  local y = y * 2
  return y
end
-- run: redeclared time=1
-- expect: 4
