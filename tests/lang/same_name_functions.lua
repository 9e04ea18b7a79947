-- Local functions of one name in nested scopes.
local function f(x) return x + 1 end
function outer(time)
  local a = f(time)
  local function f(x) return x * 10 end
  local b = f(time)
  do
    local function f(x) return x - 100 end
    a = a + f(b)
  end
  return a, f(a)
end
-- run: outer time=2
-- expect: -77, -770
function recursive_name(time)
  local f = f(time)
  return f
end
-- run: recursive_name time=2
-- expect: 3
