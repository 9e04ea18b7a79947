-- What a maker of closures is called with may turn out to be a number only late; its closure's name stands for that one.
local function maker(a)
  local n = a
  return function(x)
    n = n + x
    return n
  end
end
local function pair(a) return { a, a } end

function widened(p)
  local x, y, z = 0, 0, 0
  local sum = 0.0
  for i = 1, 4 do
    local g = maker(x)
    local t = pair(x)
    sum = sum + g(1) + t[2]
    x = y
    y = z
    z = z + p.x
  end
  return sum
end
-- run: widened p=0.5,0,0
-- expect: 5

local function uncalled(a, b)
  local g = maker(a * 2)
  a = 1.5
  return g(b)
end
