-- Conditions that do not depend on the point: branches and loops that all lanes share.
local quality = param("quality", 2)
local limit = quality * 3
local function shade(p, octaves)
  local sum, weight = 0.0, 1.0
  for k = 1, octaves do
    if octaves > 4 then sum = sum + weight * perlin(p * k) else sum = sum + weight * p.x end
    weight = weight * 0.5
  end
  return sum
end
function color(p)
  local c = vec3(0)
  if quality > 1 then c = c + shade(p, limit) end
  if quality > 5 then return c * 2 end
  for k = 1, limit do
    if k == 3 then break end
    c = c + vec3(k, p.y, 0)
  end
  return c
end
function flat() return quality > 1 and 1.0 or 0.0 end
-- run: flat
-- expect: 1
-- run: flat -D quality=1
-- expect: 0
