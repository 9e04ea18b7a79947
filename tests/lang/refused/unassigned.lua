function height(p)
  local x
  if p.x > 0 then x = 1 end
  local y
  while p.y > 5 do y = 2.0 break end
  return x + y
end
-- error: 6:10 unassigned-variable
-- error: 6:14 unassigned-variable
