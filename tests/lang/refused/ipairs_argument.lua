function height(p)
  local s = 0.0
  for _, v in ipairs(p) do s = s + v end
  for _, v in ipairs({ x = 1 }) do s = s + v end
  for _, v in ipairs({ 1, 2 }, 3) do s = s + v end
  for _, v in ipairs() do s = s + v end
  return s
end
-- error: 3:22 ipairs-argument
-- error: 4:22 ipairs-argument
-- error: 5:22 ipairs-argument
-- error: 6:15 ipairs-argument
