function height(p)
  local x = p.x > 0 and p or 1
  return p.x
end
-- error: 2:13 conditional-types
