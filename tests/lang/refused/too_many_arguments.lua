local function f(a) return a end
function height(p)
  return f(p.x, 2) + sin(1, 2)
end
-- error: 3:29 too-many-arguments
