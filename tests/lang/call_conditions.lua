-- Calls with effects in conditions: run as often, and where, Lua runs them.
function in_while(frame)
  local n = 0
  local function up() n = n + 1 return n > (frame & 7) end
  while not up() do
    if n > 5 then break end
  end
  return n
end
-- run: in_while frame=3
-- expect: 4
function either(p)
  local calls = 0
  local function test(x)
    calls = calls + 1
    return x > 0
  end
  local a = test(p.x) or test(p.y) and test(p.z)
  local b = test(p.x) and (test(p.y) or test(p.z))
  local c = (test(p.x) and 1 or test(p.y) and 2 or 3)
  return calls, a, b, c
end
-- run: either p=1,1,1
-- expect: 4, true, true, 1
-- run: either p=-1,1,-1
-- expect: 6, false, false, 2
function until_call(p)
  local x = 0.0
  local function far()
    x = x + abs(p.x) + 0.5
    if x > 4 then return true end
    return x > p.y
  end
  local k = 0
  repeat
    k = k + 1
    if k > 8 then break end
  until far()
  return x, k
end
-- run: until_call p=1,10,0
-- expect: 4.5, 3
