-- Branches over noise; early returns of vectors.
local sea = param("sea", 0.05)
local function terrain(p) return fbm(p * 1.5, 5, 2.05, 0.52) - sea end
function color(p)
  local h = terrain(p)
  if h < 0 then return mix(vec3(0.03, 0.2, 0.3), vec3(0.01, 0.03, 0.12), smoothstep(0, -0.35, h)) end
  local latitude = abs(normalize(p).y)
  local line = 0.42 - 0.55 * latitude * latitude
  if h > line and latitude > 0.2 then return vec3(0.9) end
  local land = vec3(0.1, 0.2, 0.04)
  for k = 1, 3 do
    if h * k > 0.3 then land = mix(land, vec3(0.24, 0.19, 0.15), 0.5) end
    if k == 2 and h < 0.1 then break end
  end
  return land
end
function height(p) return max(terrain(p), 0) end
