-- worley.lua: the distance to the nearest feature point, one in each cell
function height(p)
  return (worley(p))
end
