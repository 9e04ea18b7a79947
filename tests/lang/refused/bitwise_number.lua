function height(p)
  return p.x & 3 | ~p.y << 1.5
end
-- error: 2:10 bitwise-number
-- error: 2:21 bitwise-number
-- error: 2:28 bitwise-number
