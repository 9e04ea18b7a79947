-- Makes vase.obj: a lathed vase with normals and texture coordinates.  lua5.4 make_vase.lua > vase.obj
local ROUND, TALL = 72, 56

-- radius of the profile at height y in 0..1
local function radius(y)
  local belly = 0.52 * math.sin(math.pi * (0.12 + 0.80 * y) ^ 0.85) ^ 1.4
  local foot = 0.16 * math.exp(-((y - 0.01) / 0.05) ^ 2)
  local lip = 0.13 * math.exp(-((y - 1.0) / 0.055) ^ 2)
  return 0.10 + belly + foot + lip
end

local function point(u, v)
  local a, r = 2 * math.pi * u, radius(v)
  return r * math.cos(a), 1.6 * v, r * math.sin(a)
end

local function normal(u, v)
  local e = 1e-4
  local slope = (radius(v + e) - radius(v - e)) / (2 * e) / 1.6
  local a, l = 2 * math.pi * u, math.sqrt(1 + slope * slope)
  return math.cos(a) / l, -slope / l, math.sin(a) / l
end

io.write("# A vase for Moonshade, made by make_vase.lua.\nmtllib vase.mtl\no vase\nusemtl copper\n")
for j = 0, TALL do
  for i = 0, ROUND do
    local u, v = i / ROUND, j / TALL
    io.write(("v %.5f %.5f %.5f\n"):format(point(u, v)))
    io.write(("vt %.5f %.5f\n"):format(u, v))
    io.write(("vn %.4f %.4f %.4f\n"):format(normal(u, v)))
  end
end
local function corner(i, j)
  local k = j * (ROUND + 1) + i + 1
  return ("%d/%d/%d"):format(k, k, k)
end
for j = 0, TALL - 1 do
  for i = 0, ROUND - 1 do
    io.write("f ", corner(i, j), " ", corner(i, j + 1), " ", corner(i + 1, j + 1), " ", corner(i + 1, j), "\n")
  end
end
