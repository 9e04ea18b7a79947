-- bricks.lua: a brick wall in x and y, filtered to the footprint: no line of mortar flickers in the distance
local course = param("course", 0.085, { min = 0.001, max = 10, doc = "height of a brick and its mortar" })
local mortar = param("mortar", 0.15, { min = 0, max = 0.9, doc = "share of the course that is mortar" })

local DARK   <const> = rgb(0.20, 0.055, 0.04)
local LIGHT  <const> = rgb(0.50, 0.19, 0.11)
local MORTAR <const> = rgb(0.40, 0.37, 0.33)

-- 1 on a brick and 0 in the mortar, beside a number of the brick's own
local function wall(p, fw, bevel)
  local face, id = brick(vec2(p.x, p.y) / course, fw / course, mortar, bevel, 0.5, 3)
  return face, mix(id, 0.5, smoothstep(0.3, 1.5, fw / course)) -- where a pixel holds several, their mean
end

function color(p, fw)
  local face, id = wall(p, fw, 0.04)
  local burnt = 0.5 + 0.5 * fbm(p * 11, 5, 2, 0.5, fw * 11)
  local clay = mix(DARK, LIGHT, saturate(0.8 * id + 0.5 * burnt - 0.15))
  local damp = smoothstep(0.45, -0.1, p.y + 0.3 * fbm(p * 1.7, 4, 2, 0.5, fw * 1.7)) -- risen from below
  return mix(MORTAR * (0.75 + 0.5 * burnt), clay, face) * mix(1, 0.45, damp)
end

function height(p, fw)
  local face, id = wall(p, fw, 0.12)
  return course * (0.07 * face * (0.7 + 0.6 * id) + 0.004 * fbm(p * 45, 4, 2, 0.5, fw * 45))
end

function roughness(p, fw)
  return mix(1, 0.8, (wall(p, fw, 0.04)))
end
