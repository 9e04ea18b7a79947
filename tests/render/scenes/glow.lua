-- A panel that glows in stripes.
function emission(p)
  return rgb(6, 4, 2) * step(0, sin(p.x * 9))
end
