function height(p)
  local x = p
  x = p.x
  local b = true
  b = 1
  return p.x
end
-- error: 3:7 type-conflict
-- error: 5:7 type-conflict
