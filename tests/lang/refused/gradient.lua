function several(q) return q.x, q.y end
function nothing(q) local x = q.x; x = x + 1 end
function vector(q) return q * 2 end
function two(q, r) return q.x + r end
function height(p)
  local sum, n = 0.0, 0
  local function counts(q)
    n = n + 1
    return q.x
  end
  local a = gradient(several, p)
  local b = gradient(nothing, p)
  local c = gradient(vector, p)
  local d = gradient(counts, p)
  local e = gradient(two, p)
  local f = gradient(p, p)
  local g = gradient(height_of, true)
  local h = gradient(vector)
  local i = gradient(several, p, 3)
  local j = fwidth(sin, 1, p)
  local k = gradient(sin, p)
  local l = gradient(math.floor, 1)
  local m = gradient(function(q)
    sum = sum + q.x
    return sum
  end, p)
  local o = gradient(dot, p)
  return sum
end
-- error: 11:22 gradient-result
-- error: 12:22 gradient-result
-- error: 13:22 gradient-result
-- error: 14:22 gradient-assigns
-- error: 15:13 missing-argument
-- error: 16:22 argument-type
-- error: 17:22 unknown-name
-- error: 18:13 missing-argument
-- error: 19:34 too-many-arguments
-- error: 20:28 argument-type
-- error: 21:22 gradient-result
-- error: 22:22 argument-type
-- error: 23:22 gradient-assigns
-- error: 27:13 missing-argument
