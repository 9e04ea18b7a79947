-- ripples.lua: a dark mirror whose reflections a bump disturbs
local scale  = param("scale", 1.3, { min = 0.1, max = 40, doc = "waves a unit of length" })
local amount = param("amount", 0.035, { min = 0, max = 1, doc = "height of the waves" })
local tint   = param("tint", rgb(0.75, 0.80, 0.85), { doc = "colour of the reflection" })

function height(p)
  local q = vec3(p.x, 0.5 * p.y, p.z) * scale
  return amount * (fbm(q, 3) + 0.35 * noise(q * 3.1))
end

function color(p)
  return rgb(0.015, 0.03, 0.04)
end

-- mirrors reflect more at grazing angles (Schlick 1994)
function reflectance(p, n, i)
  local facing = saturate(-dot(n, i))
  return tint * mix(0.25, 1, (1 - facing) ^ 5)
end
