function height(p)
  assert(p.x > 0, p.y)
  error(p.x)
  return p.x
end
-- error: 2:19 message-constant
-- error: 3:9 message-constant
