-- Makes bowl.obj and spindle.obj, as a lathe turns them, with normals.  lua5.4 make_turned.lua bowl > bowl.obj
local ROUND <const> = 56

-- Profiles as lists of { radius, height }, from the bottom's middle outwards, over the rim and back in; rounded by
-- Catmull and Rom's spline.
local BOWL <const> = {
  { 0.00, 0.00 }, { 0.30, 0.00 }, { 0.36, 0.01 }, { 0.37, 0.05 }, { 0.34, 0.08 }, { 0.48, 0.14 }, { 0.66, 0.26 }, { 0.77, 0.40 },
  { 0.82, 0.52 }, { 0.81, 0.55 }, { 0.785, 0.53 }, { 0.72, 0.40 }, { 0.60, 0.27 }, { 0.42, 0.17 }, { 0.20, 0.125 }, { 0.00, 0.12 },
}
local SPINDLE <const> = {
  { 0.000, 0.000 }, { 0.150, 0.000 }, { 0.170, 0.020 }, { 0.170, 0.060 }, { 0.120, 0.080 }, { 0.080, 0.120 }, { 0.075, 0.180 }, { 0.110, 0.260 },
  { 0.140, 0.340 }, { 0.130, 0.420 }, { 0.080, 0.500 }, { 0.060, 0.560 }, { 0.065, 0.590 }, { 0.110, 0.600 }, { 0.125, 0.625 }, { 0.110, 0.650 },
  { 0.065, 0.660 }, { 0.060, 0.690 }, { 0.055, 0.800 }, { 0.065, 0.900 }, { 0.100, 0.930 }, { 0.105, 0.960 }, { 0.090, 1.020 }, { 0.050, 1.070 }, { 0.000, 1.090 },
}
local BETWEEN <const> = 2 -- points between two of the list

local function spline(a, b, c, d, t)
  return 0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t * t * t)
end

local function smooth(profile)
  local points = {}
  for k = 1, #profile - 1 do
    local a, b, c, d = profile[math.max(k - 1, 1)], profile[k], profile[k + 1], profile[math.min(k + 2, #profile)]
    for j = 0, BETWEEN do
      local t = j / (BETWEEN + 1)
      points[#points + 1] = { math.max(spline(a[1], b[1], c[1], d[1], t), 0), spline(a[2], b[2], c[2], d[2], t) }
    end
  end
  points[#points + 1] = profile[#profile]
  return points
end

local name = arg[1]
local points = smooth(name == "spindle" and SPINDLE or BOWL)
io.write("# Turned wood for Moonshade, made by make_turned.lua.\no ", name, "\n")
for k, point in ipairs(points) do
  local before, after = points[math.max(k - 1, 1)], points[math.min(k + 1, #points)]
  local along, up = after[1] - before[1], after[2] - before[2]
  local length = math.sqrt(along * along + up * up)
  for i = 0, ROUND - 1 do
    local angle = 2 * math.pi * i / ROUND
    local c, s = math.cos(angle), math.sin(angle)
    io.write(("v %.4f %.4f %.4f\n"):format(point[1] * c, point[2], point[1] * s))
    io.write(("vn %.3f %.3f %.3f\n"):format(up / length * c, -along / length, up / length * s))
  end
end
for k = 0, #points - 2 do
  for i = 0, ROUND - 1 do
    local a, b = k * ROUND + i + 1, k * ROUND + (i + 1) % ROUND + 1
    local corners = { a, a + ROUND, b + ROUND, b }
    -- where a ring is a point, two of the corners are one
    if points[k + 1][1] == 0 then table.remove(corners, 4) end
    if points[k + 2][1] == 0 then table.remove(corners, 3) end
    io.write("f")
    for _, corner in ipairs(corners) do io.write((" %d//%d"):format(corner, corner)) end
    io.write("\n")
  end
end
