-- assert passes on all that it gets: every value of a call that ends its arguments, and what is no boolean always holds.
local function both(x) return x * 2, x + 1 end
local function checked(x) return x > 0, x + 1, x - 1 end
local function named(x) return x < 3, "too large" end
local function made(x) return { value = x }, x + 3 end

function height(time)
  local x, y = assert(both(time))
  return x + y
end
-- run: height time=3
-- expect: 10

function three(time)
  local ok, up, down = assert(checked(time))
  return ok, up, down
end
-- run: three time=3
-- expect: true, 4, 2
-- run: three time=-1
-- expect: fault: assert

function behind(time)
  local a, b, c = assert(time > 0, "negative", both(time))
  local ok, text, x, y = assert(time > 0, "negative", both(time))
  return a, c, x, y
end
-- run: behind time=3
-- expect: true, 6, 6, 4
-- run: behind time=-3
-- expect: fault: assert

local function passed(time) return assert(both(time)) end
function tail(time)
  local x, y = passed(time)
  return x, y
end
-- run: tail time=3
-- expect: 6, 4

function result(time) return assert(both(time)) end
-- run: result time=5
-- expect: 10, 6

function argument(time) return math.max(assert(both(time))) end
-- run: argument time=-5
-- expect: -4

function first(time) return (assert(both(time))) end
-- run: first time=5
-- expect: 10

function nested(time)
  local x, y = assert(assert(both(time)))
  local v, w = assert(vec3(x, y, 1), 2)
  assert(both(time))
  return x + y + v.x, w
end
-- run: nested time=1
-- expect: 6, 2

function text(time)
  assert(named(time))
  local ok = assert(named(time))
  return ok and time or 0
end
-- run: text time=2
-- expect: 2
-- run: text time=4
-- expect: fault: assert

function tables(time)
  local t, x = assert(made(time))
  return t.value + x
end
-- run: tables time=2
-- expect: 7

function assigned(time)
  local x, y
  x, y = assert(both(time))
  return x - y
end
-- run: assigned time=4
-- expect: 3

function in_branch(time)
  local x, y = 1, 2.0
  if time > 0 then x, y = assert(both(time)) end
  return x + y
end
-- run: in_branch time=1
-- expect: 4
