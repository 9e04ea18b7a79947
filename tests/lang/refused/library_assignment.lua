math.pi = 3
function height(p)
  math.huge = 1.0
  return p.x
end
-- error: 1:1 library-assignment
-- error: 3:3 library-assignment
