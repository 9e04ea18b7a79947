-- Booleans in variables, captured, carried through loops and returned.
function flags(p)
  local any, all = false, true
  for k = 1, 5 do
    local inside = p.x * k > 2 and p.y < k
    any = any or inside
    all = all and inside
  end
  return any, all, any ~= all, not any
end
-- run: flags p=1,0,0
-- expect: true, false, true, false
local function between(x, low, high) return x >= low and x < high, x == low end
function results(time)
  local inside, exactly = between(time, 0, 1)
  if inside and not exactly then return 1, inside end
  return exactly and 2 or 3, inside
end
-- run: results time=0
-- expect: 2, true
-- run: results time=0.5
-- expect: 1, true
function toggled(frame)
  local on = false
  local function toggle() on = not on end
  for k = 0, 7 do
    if (frame >> k) & 1 == 1 then toggle() end
  end
  return on
end
-- run: toggled frame=7
-- expect: true
