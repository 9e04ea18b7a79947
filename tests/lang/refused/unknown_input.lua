function height(p, q, position)
  return p.x
end
-- error: 1:20 unknown-input
-- error: 1:23 unknown-input
