-- marble.lua: veins are sine waves, bent by turbulence (Perlin 1985)
local scale  = param("scale", 2.0, { min = 0.1, max = 40, doc = "veins a unit of length" })
local bend   = param("bend", 3.6, { min = 0, max = 20, doc = "how far turbulence bends the veins" })
local octaves <const> = 7

local WHITE <const> = rgb(0.88, 0.87, 0.84)
local GREY  <const> = rgb(0.46, 0.47, 0.49)
local DARK  <const> = rgb(0.10, 0.11, 0.13)

-- 0 beside a vein, 1 in it
local function vein(p)
  local wave = sin(scale * (p.x + 0.6 * p.y) * 3 + bend * turbulence(p * scale * 0.5, octaves))
  return pow(1 - abs(wave), 3)
end

function color(p)
  local cloud = 0.5 + 0.5 * fbm(p * scale * 0.7, 4)
  local stone = mix(WHITE, GREY, 0.45 * smoothstep(0.35, 0.8, cloud))
  return mix(stone, DARK, 0.8 * vein(p))
end

function roughness(p)
  return 0.3 + 0.2 * vein(p)
end
