-- Records, tables inside tables, and references to them: a change is seen by every name.
local LIGHT = { from = vec3(0, 3, 4), power = 2.5, ring = { inner = 0.25, outer = 1 } }
local LAYERS = {
  { weight = 1, offset = vec3(0.5), gains = { 1.0, 2.0 } },
  { weight = 0.5, offset = vec3(0, 1, 0), gains = { 3.0, 4.0 } },
  { weight = 0.25, offset = vec3(2), gains = { 5.0, 6.0 } },
}

function lit(p)
  return dot(normalize(LIGHT.from), p) * LIGHT.power + LIGHT.ring.inner + LIGHT["ring"].outer
end
-- run: lit p=0,3,4
-- expect: 13.75

function layered(p, id)
  local sum = 0.0
  for i, layer in ipairs(LAYERS) do
    sum = sum + layer.weight * dot(p, layer.offset) + layer.gains[id % 2 + 1] * i
  end
  return sum + LAYERS[id % 3 + 1].gains[1]
end
-- run: layered p=0,0,0 id=1
-- expect: 31

function swap_fields(p)
  local r = { a = p.x, b = p.y }
  local alias = r
  alias.a, r.b = r.b, alias.a
  return r.a, r.b
end
-- run: swap_fields p=1,2,0
-- expect: 2, 1

local function scale(ray, k)
  ray.dir = ray.dir * k
  ray.hits[1] = ray.hits[1] + 1
  return ray
end
function through_calls(p)
  local ray = { from = p, dir = p + 1, hits = { 0, 0 } }
  local same = scale(ray, 2)
  scale(same, 3)
  return ray.dir, same.hits[1]
end
-- run: through_calls p=0,0,0
-- expect: 6, 6, 6, 2

function matrix(p, id)
  local m = { { 1, 0, 0 }, { 0, p.x, 0 }, { 0, 0, p.y } }
  local row = m[2]
  row[3] = 7
  m[id % 3 + 1][2] = m[id % 3 + 1][2] + 100
  for i, r in ipairs(m) do r[1] = r[1] + i end
  return m[1][1] + m[2][1] * 10, m[2][2], m[2][3], m[3][2]
end
-- run: matrix p=5,0,0 id=1
-- expect: 22, 105, 7, 0

function branches(p)
  local t
  if p.x > 0 then
    t = { k = p.x, n = { 1, 2 } }
  elseif p.x < -1 then
    t = { n = { 3, 4 }, k = 1 }
  else
    t = { k = p.y, n = { 5, 6 } }
  end
  local u = p.y > 0 and { 1.5, 2 } or p.z > 0 and { p.z, 3 } or { 0, 0 }
  u[1] = u[1] + t.k
  return t.n[1] + t.n[2] * 10 + u[1] * u[2]
end

function fresh_each_time(p)
  local sum = 0.0
  for i = 1, 3 do
    local t = { 0.0, i }
    t[1] = t[1] + p.x
    sum = sum + t[1] * t[2]
  end
  return sum
end
-- run: fresh_each_time p=1,0,0
-- expect: 6

function copied_in(p)
  local a, b = { x = p.x }, { x = 2.0 }
  local both = { a, b }
  return both[math.floor(abs(p.y) % 2) + 1].x
end

function referred_to(p)
  local shared = { 1.0, 2.0 }
  local r = { data = shared, k = 1 }
  r.data[1] = p.x
  shared[2] = p.y
  return shared[1] + r.data[2] + r.k
end
-- run: referred_to p=3,4,0
-- expect: 8

-- A name for a constant string names a field.
local which <const> = "second"
function named(time)
  local r = { first = time, second = 2 * time, inner = { third = 3 } }
  local key = "inner"
  r[which] = r[which] + 1
  return r[which], r["first"], r[key]["third"], r[(key)].third
end
-- run: named time=2
-- expect: 5, 2, 3, 3
