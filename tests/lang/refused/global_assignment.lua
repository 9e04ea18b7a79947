function height(p)
  counter = p.x
  return p.x
end
-- error: 2:3 global-assignment
