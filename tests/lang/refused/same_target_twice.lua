function height(p)
  local a
  a, a = p.x, p.y
  return a
end
-- error: 3:6 order-of-evaluation
