function height(p)
  assert(p.x > 0, "x" .. "y")
  error(tostring(1))
  return p.x
end
-- error: 2:19 string-building
-- error: 3:9 string-building
