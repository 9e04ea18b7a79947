function color(p)
  p.x = 1
  p[2] = 3
  return p
end
-- error: 2:3 vector-component
-- error: 3:3 vector-component
