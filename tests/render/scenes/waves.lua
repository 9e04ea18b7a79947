local depth = param("depth", 0.02)

function height(p)
  return depth * sin(20 * p.x)
end
