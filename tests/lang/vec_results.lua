-- Functions that give several vectors and numbers; their results taken apart.
local function frame_of(n)
  local side = abs(n.x) > 0.5 and vec3(0, 1, 0) or vec3(1, 0, 0)
  local t = normalize(cross(side, n))
  return t, cross(n, t), dot(t, n)
end
function basis(n)
  local t, b, d = frame_of(normalize(n))
  return t, b, d
end
function sums(n, p)
  local t, b = frame_of(n)
  return (frame_of(p)).x + t.y * b.z, dot(t, b), (p:cross(n) + t).zyx
end
function color(p)
  local a, b = frame_of(p)
  a, b = b.yzx, a * 0.5
  return a - b
end
