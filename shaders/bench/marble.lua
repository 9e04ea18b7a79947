-- marble.lua: veins are a sine wave, bent by turbulence of six octaves of simplex noise
local LIGHT <const> = rgb(0.90, 0.88, 0.84)
local VEIN  <const> = rgb(0.28, 0.30, 0.34)

function color(p)
  local bend, q, weight = 0.0, p, 1.0
  for _ = 1, 6 do
    bend = bend + weight * abs(noise(q))
    q, weight = q * 2, weight * 0.5
  end
  return mix(VEIN, LIGHT, 0.5 + 0.5 * sin(2 * p.x + 5 * bend))
end
