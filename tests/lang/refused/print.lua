local label = param("label", "x")
function height(p)
  local mixed = 1
  mixed = mixed + p.x
  print(mixed)
  print(noise, p)
  print("fine", label)
  print(p, nil)
  return mixed
end
-- error: 5:9 mixed-number
-- error: 6:9 argument-type
-- error: 7:17 argument-type
-- error: 8:12 nil-value
