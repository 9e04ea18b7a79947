-- planet.lua: sea, land and snow by a height of eight octaves of Perlin noise
local DEEP    <const> = rgb(0.01, 0.04, 0.12)
local SHALLOW <const> = rgb(0.03, 0.20, 0.30)
local GRASS   <const> = rgb(0.09, 0.21, 0.05)
local ROCK    <const> = rgb(0.24, 0.19, 0.15)
local SNOW    <const> = rgb(0.90, 0.92, 0.95)

local function relief(p)
  local sum, weight = 0.0, 1.0
  for _ = 1, 8 do
    sum = sum + weight * perlin(p)
    p, weight = p * 2, weight * 0.5
  end
  return sum
end

function color(p)
  local h = relief(p * 0.5)
  if h < 0 then
    return mix(SHALLOW, DEEP, min(-2 * h, 1))
  elseif h < 0.4 then
    return mix(GRASS, ROCK, 2.5 * h)
  else
    return mix(ROCK, SNOW, min(4 * (h - 0.4), 1))
  end
end
