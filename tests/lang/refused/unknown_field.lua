function height(p)
  return p.q + p.xyq.x + math.flor(p.x) + uv
end
-- error: 2:12 unknown-field
-- error: 2:18 unknown-field
-- error: 2:31 unknown-field
-- error: 2:43 unknown-name
