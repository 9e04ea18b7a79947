-- Vectors carried through loops and branches.
function orbit(p, n)
  local v, best = p, 1e9
  for k = 1, 12 do
    v = abs(v) / max(dot(v, v), 0.01) - 0.5
    if v:length() < best then best = v:length() end
    if v.x > 4 then
      v = v.yzx
      if v.y < 0 then break end
    end
  end
  return v, best
end
function rotate_twice(p, backface)
  local v = p
  repeat
    v = vec3(-v.y, v.x, v.z)
    if backface then break end
    v = v * 2
  until v.z > 10 or v.z <= 0 or v.z ~= v.z
  return v
end
