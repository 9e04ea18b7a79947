function height(p)
  local a, b = p.x
  local c, d
  c, d = p.x
  return a
end
-- error: 4:6 missing-value
