-- Integer cells from coordinates, hashes of cells.
-- mild
function color(p)
  local row = math.floor(p.y * 3)
  local shift = (row & 1) * 0.5
  local x = p.x * 1.5 + shift
  local column = math.floor(x)
  local fx, fy = x - column, p.y * 3 - row
  if fx < 0.05 or fy < 0.1 then return vec3(0.7) end
  local tone = 0.8 + 0.4 * hash(vec2(column, row))
  return vec3(0.6, 0.2, 0.15) * tone
end
