function height(p)
  if p.x then return 1 end
  while 1 do end
  repeat until p.y
  return not p.z and 1 or 0
end
-- error: 2:6 number-as-condition
-- error: 3:9 number-as-condition
-- error: 4:16 number-as-condition
-- error: 5:14 number-as-condition
