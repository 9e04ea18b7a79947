-- cloud.lua: weather in a thin shell around a planet of radius 1
local cover     = param("cover", 0.46, { min = 0, max = 1, doc = "share of the sky that is overcast" })
local thickness = param("thickness", 190, { min = 0, max = 5000, doc = "extinction of the densest cloud" })

local FLOOR <const> = 1.012
local TOP   <const> = 1.034

function density(p)
  local r = length(p)
  local height = (r - FLOOR) / (TOP - FLOOR)
  if height < 0 or height > 1 then return 0 end
  local d = p / r
  -- bands of weather, drawn out along the latitude and stirred
  local q = vec3(d.x, 2.2 * d.y, d.z) * 2.6
  q = q + 0.5 * vec3(noise(q * 1.7), noise(q * 1.7 + 31), noise(q * 1.7 + 67))
  local weather = 0.5 + 0.5 * fbm(q, 6) - (1 - cover) * 0.62
  local shape = weather - 0.35 * abs(height - 0.35) + 0.10 * noise(p * 28)
  return thickness * smoothstep(0.10, 0.46, shape)
end

function color(p) return rgb(0.99) end
function anisotropy() return 0.4 end
