function height(p)
  for k = 1, p do end
  for k = true, 2 do end
  for k = 1, 2, "x" do end
  return p.x
end
-- error: 2:14 loop-number
-- error: 3:11 loop-number
-- error: 4:17 loop-number
