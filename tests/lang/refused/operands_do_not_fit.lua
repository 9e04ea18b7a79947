function color(p, uv)
  local a = p + uv
  local b = p == 1
  local c = p < p
  return p
end
-- error: 2:13 operands-do-not-fit
-- error: 3:13 operands-do-not-fit
-- error: 4:13 operand-type
-- error: 4:17 operand-type
