function height(p)
  local x = p.x > 0 or p.y
  return 1
end
-- error: 2:24 or-operand
