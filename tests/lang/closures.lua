-- Functions as values: arguments, results, fields; what they capture lives as long as they do.
local function counter(start, step)
  local n = start
  return function(k)
    n = n + step * k
    return n
  end
end

function counters(p)
  local up = counter(0.0, 1)
  local down = counter(p.x, -2)
  up(1)
  up(2)
  down(1)
  return up(3), down(p.y)
end
-- run: counters p=10,1,0
-- expect: 6, 6

local function twice(f, x) return f(f(x)) end
local function compose(f, g) return function(x) return f(g(x)) end end
local function add(k) return function(x) return x + k end end

function higher_order(p)
  local f = compose(add(1), compose(sqrt, add(p.x)))
  return twice(add(p.y), 1) + twice(function(x) return twice(add(2), x) end, p.z), f(8)
end
-- run: higher_order p=1,2,3
-- expect: 16, 4

local shapes = {
  area = function(w, h) return w * h end,
  edge = function(w, h) return 2 * (w + h) end,
  scale = 0.5,
}
function fields(p)
  return shapes.area(p.x, p.y) * shapes.scale, shapes.edge(1, p.y)
end
-- run: fields p=2,3,0
-- expect: 3, 8

local function account(balance)
  local state = { total = balance, moves = 0 }
  local function deposit(k)
    state.total = state.total + k
    state.moves = state.moves + 1
  end
  return { deposit = deposit, read = function() return state.total, state.moves end }
end
function objects(p)
  local a, b = account(1.0), account(p.x)
  a.deposit(2)
  b.deposit(p.y)
  b.deposit(0.5)
  local total, moves = a.read()
  return total * 100 + moves, (b.read())
end
-- run: objects p=1,2,0
-- expect: 301, 3.5

local function integrate(f, a, b, n)
  local sum, h = 0.0, (b - a) / n
  for i = 0, n - 1 do sum = sum + f(a + (i + 0.5) * h) end
  return sum * h
end
function integrals(p)
  local k = p.x
  return integrate(function(x) return k * x * x end, 0, 1, 16) + integrate(cos, 0, 1, 4)
end

local function fold(t, f, start)
  local value = start
  for _, x in ipairs(t) do value = f(value, x) end
  return value
end
function folds(p)
  local t = { p.x, p.y, p.z }
  return fold(t, function(a, b) return a + b end, 0.0), fold(t, max, -1000.0), fold({ 2, 3, 4 }, function(a, b) return a * b end, 1)
end
-- run: folds p=1,5,2
-- expect: 8, 5, 24

local function pick(c, t)
  local r = { low = t[1], high = t[1] }
  for _, v in ipairs(t) do
    if v < r.low then r.low = v end
    if v > r.high then r.high = v end
  end
  if c then
    return { low = -r.high, high = -r.low }
  end
  return { low = r.low, high = r.high }
end
function ranges(p)
  local r = pick(p.x > p.y, { p.x, p.y, p.z })
  local s = pick(false, { r.low, 0 })
  return r.low, r.high, s.high
end
-- run: ranges p=3,1,2
-- expect: -3, -1, 0
