local function one(x) return x end
local function none(x) end
function height(p)
  local a, b = assert(one(p.x))
  assert(p.x)
  assert(p.x > 0, one(p.x))
  assert(none(p.x))
  assert()
  return a + b
end
-- error: 5:10 number-as-condition
-- error: 6:19 message-constant
-- error: 7:3 missing-argument
-- error: 8:3 missing-argument
-- error: 9:14 unassigned-variable
