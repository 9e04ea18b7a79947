local x = 1
function height(p)
  x(1)
  return p.x(2)
end
-- error: 3:3 not-callable
-- error: 4:10 not-callable
