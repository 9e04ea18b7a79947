function height(p)
  return math.random() + math.random(3)
end
-- error: 2:10 random-numbers
-- error: 2:26 random-numbers
