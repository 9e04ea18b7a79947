-- Forms that few shaders use: conditional chains in parentheses, results cut by parentheses, loops at the edges of the
-- integers, comparisons past 2^53, gotos out of three kinds of loops.
local function res3(x) return x, x * 2, x * 3 end
local function res2(x) return x, -x end
function beyond_53(id)
  local f = 9007199254740993 + (id & 7)
  return f == f + 0.0, f < f + 0.0, f > f + 0.0, 9007199254740993 < 9007199254740992.0, id < math.huge, id < 0 / 0,
      id == 9.2233720368547758e18, id <= 9.2233720368547758e18, id >= -9.2233720368547758e18
end
function cut(time)
  local a, b, c, d = 0, res3(time)
  local e, f = res3(time), 7
  local g = (res3(time))
  return a, b, c, d, e, f, g, vec3(res3(time)), vec3(res2(time), 3, (res2(time))), max(res2(time)), res2(5)
end
function float_loops()
  local s, c = 0.0, 0
  for x = 0, 1, 0.1 do s, c = s + x, c + 1 end
  for x = 1, 0, -0.1 do c = c + 1 end
  for i = 1, 0.5 do c = c + 100 end
  for i = -1, -0.5 do c = c + 10000 end
  return s, c
end
function edge_loops(id)
  local c = 0
  for i = id, id + 3 do c = c + (i & 1) end
  for i = id, id - 3, -2 do c = c + 10 end
  for i = math.maxinteger - 1, math.maxinteger, 2 do c = c + 100 end
  for i = math.mininteger + 1, math.mininteger, -1 do c = c + 1000 end
  for i = 1, -math.huge do c = -1 end
  return c
end
function conditions(p, backface)
  local a = backface and p.x > 0 or not backface and p.y > 0
  local b = (backface or p.x > 1) and (p.y > 1 or not (p.z > 1))
  local c = a and p or b and p * 2 or p * 3
  local d = (a and 1 or 2) + (b and 10 or 20)
  local e = a and (b and 1 or 2) or (b and 3 or 4)
  return c, d, e, a == b and 1.5 or 2, not a and vec2(1) or vec2(2), a ~= b
end
function three_kinds(p)
  local s = 0.0
  for a = 1, 3 do
    for b = a, 3 do
      local c = 0
      while c < 5 do
        c = c + 1
        repeat
          if p.x * c > 2 then goto next_b end
          if p.y * c > 4 then goto next_a end
          if p.z > 100 then return s, a, b, c end
          s = s + p.x * a + p.y * b
        until true
      end
      ::next_b::
    end
    ::next_a::
  end
  return s, 0, 0, 0
end
-- run: beyond_53 id=0
-- expect: false, false, true, false, true, false, false, true, true
-- run: cut time=2.5
-- expect: 0, 2.5, 5, 7.5, 2.5, 7, 2.5, 2.5, 5, 7.5, 2.5, 3, 2.5, 2.5, 5, -5
-- run: float_loops
-- expect: 5.5, 10022
-- run: edge_loops id=3
-- expect: 2122
-- run: edge_loops id=9223372036854775806
-- expect: 2120
-- run: conditions p=1,2,3 backface=true
-- expect: 1, 2, 3, 11, 1, 1.5, 2, 2, false
-- run: three_kinds p=0.5,0.25,1
-- expect: 34, 0, 0, 0
-- run: three_kinds p=0.5,1.5,101
-- expect: 0, 1, 1, 1
