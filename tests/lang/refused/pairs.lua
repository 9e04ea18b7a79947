function height(p)
  local s = 0.0
  for k, v in pairs(p) do s = s + 1 end
  return s
end
-- error: 3:15 pairs
