function height(p)
  local x = p.x > 0 and p.y
  return x
end
-- error: 2:25 and-without-or
