local function f(n)
  if n < 1 then return 1.0 end
  return n * f(n - 1)
end
function height(p)
  return f(p.x)
end
-- error: 3:14 recursion
