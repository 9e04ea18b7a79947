-- Functions with several results, adjusted to one or all.
local function both(x, y) return x + y, x - y end
local function three(x) return x, x * 2, x * 3 end

function all(p) return both(p.x, p.y) end
-- run: all p=3,1,0
-- expect: 4, 2

function first(p) return (both(p.x, p.y)) end
-- run: first p=3,1,0
-- expect: 4

function in_the_middle(p) return three(p.x), both(p.y, p.z) end
-- run: in_the_middle p=1,5,2
-- expect: 1, 7, 3

function assigned(p)
  local a, b, c = three(p.x)
  local d, e = p.y, both(a, b)
  a, b = b, a
  return a, b, c, d, e
end
-- run: assigned p=1,2,0
-- expect: 2, 1, 3, 2, 3

function as_arguments(p) return max(both(p.x, p.y)), vec3(three(p.z)), vec2(p.x, (three(p.y))) end
-- run: as_arguments p=1,2,3
-- expect: 3, 3, 6, 9, 1, 2

function dropped(p)
  local a = three(p.x), p.y
  return a
end
-- run: dropped p=4,5,6
-- expect: 4
