local scale = param("scale", 1.0)
function height(p)
  scale = p.x
  return scale
end
-- error: 3:3 shader-has-no-memory
