-- A shader as people write them.
local scale = param("scale", 2.0, { min = 0.1, max = 10 })
local VEIN <const>, BASE <const> = rgb(0.2, 0.1, 0.05), rgb(0.9, 0.88, 0.8)
local function veins(p)
  local t = turbulence(p * scale, 4)
  return 0.5 + 0.5 * sin((p.x + t) * 8)
end
function color(p, n, i)
  local v = veins(p)
  local facing = saturate(dot(n, -i))
  return mix(VEIN, BASE, smoothstep(0.2, 0.7, v)) * (0.25 + 0.75 * facing)
end
function height(p) return 0.02 * veins(p) end
function roughness(p)
  if veins(p) < 0.3 then return 0.9 end
  return 0.2
end
