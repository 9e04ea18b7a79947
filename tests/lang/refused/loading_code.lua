function height(p)
  load("return 1")
  dofile("x.lua")
  return p.x
end
-- error: 2:3 loading-code
-- error: 3:3 loading-code
