-- planet.lua: oceans, coasts and snow, all from one height function that colour and bump share
local scale  = param("scale", 1.4, { min = 0.1, max = 20, doc = "continents a radius" })
local sea    = param("sea", 0.05, { min = -1, max = 1, doc = "sea level" })
local relief = param("relief", 0.07, { min = 0, max = 1, doc = "height of the mountains" })
local snow   = param("snow", 0.50, { min = -1, max = 2, doc = "height of the snow line at the equator" })

local DEEP    <const> = rgb(0.010, 0.035, 0.120)
local SHALLOW <const> = rgb(0.030, 0.200, 0.300)
local SAND    <const> = rgb(0.560, 0.470, 0.290)
local GRASS   <const> = rgb(0.090, 0.210, 0.045)
local ROCK    <const> = rgb(0.240, 0.190, 0.150)
local SNOW    <const> = rgb(0.900, 0.920, 0.950)

-- height above the sea; negative below it
local function terrain(p)
  return fbm(p * scale, 9, 2.05, 0.52) - sea
end

-- the sea is flat: only land is raised
function height(p)
  return relief * max(terrain(p), 0)
end

function color(p)
  local h = terrain(p)
  if h < 0 then
    return mix(SHALLOW, DEEP, smoothstep(0, -0.35, h))
  end
  local ragged = h + 0.06 * noise(p * scale * 14)
  local latitude = abs(normalize(p).y)
  local line = snow - 0.45 * latitude * latitude * latitude
  local land = mix(SAND, GRASS, smoothstep(0.012, 0.045, ragged))
  land = mix(land, ROCK, smoothstep(0.18, 0.40, ragged))
  return mix(land, SNOW, smoothstep(line, line + 0.05, ragged))
end

-- water shines, land does not
function roughness(p)
  if terrain(p) < 0 then return 0.28 end
  return 0.95
end
