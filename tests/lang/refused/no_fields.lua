function height(time)
  return time.x + noise.y
end
-- error: 2:10 no-fields
-- error: 2:19 no-fields
