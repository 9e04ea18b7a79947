local function f(x)
  if x > 0 then return x end
end
function height(p)
  return f(p.x)
end
-- error: 3:1 missing-return
