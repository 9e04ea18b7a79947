function height(p)
  local a = -true
  local b = "x" + 1
  local c = p.x + true
  local d = #p.x
  return p.x
end
-- error: 2:14 operand-type
-- error: 3:13 operand-type
-- error: 4:19 operand-type
-- error: 5:14 operand-type
