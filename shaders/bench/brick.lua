-- brick.lua: bricks in running bond, each with a tint of its own
local MORTAR <const> = rgb(0.62, 0.60, 0.56)
local DARK   <const> = rgb(0.42, 0.14, 0.09)
local LIGHT  <const> = rgb(0.66, 0.29, 0.17)

function color(p)
  local row = floor(4 * p.y)
  local x = 2 * p.x + 0.5 * row
  local column = floor(x)
  local u, v = x - column, 4 * p.y - row
  if u < 0.04 or v < 0.08 then
    return MORTAR
  end
  return mix(DARK, LIGHT, hash(vec2(column, row)))
end
