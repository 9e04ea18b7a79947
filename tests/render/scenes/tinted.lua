local tint = param("tint", rgb(0.8, 0.4, 0.2))

function color()
  return tint
end
