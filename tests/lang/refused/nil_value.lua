function height(p)
  local x = nil
  if p.x == nil then return 1 end
  return p.x
end
-- error: 2:13 nil-value
-- error: 3:13 nil-value
