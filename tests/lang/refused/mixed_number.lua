function height(p)
  local s = 0
  for k = 1, 3 do s = s + p.x end
  return s // 2 + s % 3
end
-- error: 4:10 mixed-number
-- error: 4:19 mixed-number
