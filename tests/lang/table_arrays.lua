-- Arrays: elements by constant and computed index, on every lane its own; assignment, length, aliases.
local WEIGHTS <const> = { 0.5, 1, 2.25, -3 }
local COLOURS <const> = { rgb(1, 0.5, 0), rgb(0, 0.25, 1), vec3(2) }
local BITS <const> = { 1, 3, 7, 15 }
local FLAGS <const> = { true, false }

function gather(p)
  local i = math.floor(abs(p.x) % 4) + 1
  return WEIGHTS[i] * p.y + WEIGHTS[#WEIGHTS]
end
-- run: gather p=2.5,2,0
-- expect: 1.5

function gather_vectors(p, id)
  local c = COLOURS[id % 3 + 1]
  return c * p + COLOURS[1]
end

function integers(id)
  return BITS[id % #BITS + 1] << 2, FLAGS[id % 2 + 1]
end
-- run: integers id=2
-- expect: 28, true

function scatter(p, id)
  local t = { p.x, p.y, p.z, 0 }
  local i = id % 4 + 1
  t[i] = t[i] + 10
  t[4 - id % 4] = t[1] * 2
  local u = t
  u[2] = u[2] - 1
  return t[1], t[2], u[3], u[4]
end
-- run: scatter p=1,2,3 id=0
-- expect: 11, 1, 3, 22

function divergent(p)
  local t = { 1.5, 2.5, 3.5 }
  for i = 1, #t do
    if p.x > i then
      t[i] = t[i] * p.y
    elseif p.y > i then
      break
    end
  end
  local sum = 0.0
  for i = #t, 1, -1 do sum = sum + t[i] end
  return sum
end

function by_number(p)
  local t = { p.x, p.y }
  return t[2.0] - t[1.0]
end
-- run: by_number p=1,5,0
-- expect: 4

function prefix_sums(p)
  local t = { 1, 2, 3, 4, 5, 6, 7, 8 }
  for i = 2, #t do t[i] = t[i] + t[i - 1] end
  local m = math.floor(abs(p.x) % 8) + 1
  return t[m], #t
end
-- run: prefix_sums p=7.5,0,0
-- expect: 36, 8

local function two() return 10, 20 end
function expanded(p)
  local a = { two() }
  local b = { two(), two() }
  local c = { (two()) }
  return #a, #b, #c, b[3] + p.x
end
-- run: expanded p=1,0,0
-- expect: 2, 3, 1, 21

function sorted(p)
  local t = { p.x, p.y, p.z, p.x * p.y }
  for i = 1, #t - 1 do
    for j = 1, #t - i do
      if t[j] > t[j + 1] then t[j], t[j + 1] = t[j + 1], t[j] end
    end
  end
  return t[1], t[2], t[3], t[4]
end
-- run: sorted p=3,-1,2
-- expect: -3, -1, 2, 3
