-- A closure takes along the tables and closures that it captures, also those that it only reads.
local function maker(a)
  local t = { k = a, m = 2 }
  local list = { a, a + 1 }
  return function(x)
    return x + t.m + list[2]
  end
end
function reads(p)
  local g, h = maker(1.5), maker(p.y)
  return g(p.x), h(p.x)
end
-- run: reads p=1,5,0
-- expect: 5.5, 9

local function counter(a)
  local n = { count = 0.0 }
  return function(x)
    n.count = n.count + a * x
    return n.count
  end
end
local function doubled(a)
  local c = counter(a)
  local log = { 0.0 }
  return function(x)
    log[1] = log[1] + c(x)
    return log[1] + c(x)
  end
end
function nested(p)
  local a = doubled(1)
  local b = doubled(p.x)
  local first = a(1)
  local second = a(1)
  return first, second, b(p.y)
end
-- run: nested p=2,3,0
-- expect: 3, 8, 18

local function object(t)
  local inner = { sum = 0.0 }
  return {
    add = function(i)
      inner.sum = inner.sum + t[i]
      return inner.sum
    end,
    sum = function() return inner.sum end,
  }
end
function objects(p)
  local t = { p.x, p.y, p.z }
  local o = object(t)
  t[1] = 10
  o.add(1)
  o.add(3)
  return o.sum()
end
-- run: objects p=1,2,3
-- expect: 13
