function height(p)
  return noise(true) + dot(p, 1) + length("x") + math.floor(p)
end
-- error: 2:16 argument-type
-- error: 2:31 argument-type
-- error: 2:43 argument-type
-- error: 2:61 argument-type
