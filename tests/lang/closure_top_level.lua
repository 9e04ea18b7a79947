-- Closures made and called while the top level runs: what they captured was assigned in their maker.
local function maker(a)
  local t
  if a > 0 then
    t = { 1.0, a }
  else
    t = { 2.0, a }
  end
  return function() return t[1] + t[2] end
end
local constant = maker(1.5)
local value = constant()

function made(p)
  local made_here = maker(p.x)
  return value, constant(), made_here()
end
-- run: made p=-3,0,0
-- expect: 2.5, 2.5, -1
