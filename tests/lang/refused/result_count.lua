local function f(x)
  if x > 0 then return x end
  return x, x
end
function height(p)
  return f(p.x)
end
-- error: 3:3 result-count
