local function f(x)
  if x > 0 then return x end
  return vec3(x)
end
function height(p)
  return f(p.x)
end
-- error: 3:10 result-type
