-- one run reports every independent error
function color(p)
  local a = unknown_one
  local b = p + true
  if a then return p end
  return unknown_two
end
function height(p)
  return p
end
-- error: 3:13 unknown-name
-- error: 4:17 operand-type
-- error: 6:10 unknown-name
-- error: 9:10 entry-result
