function height(p)
  if p.x > 0 then
    p = p * 2
  for i = 1, 3 do
  end
  return 2
end
-- error: 9:1 unclosed-block
