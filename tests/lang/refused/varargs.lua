local function f(...)
  return ...
end
function height(p)
  return f(p.x)
end
-- error: 1:18 varargs
-- error: 2:10 varargs
