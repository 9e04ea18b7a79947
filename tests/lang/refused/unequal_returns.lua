-- reported once, not again where the function is called
local function f(x)
  if x > 0 then return 1, 2 end
  return 1
end
function height(p)
  if p.x > 0 then return f(p.x) end
  return 1
end
function roughness(p)
  return f(p.x)
end
-- error: 4:3 result-count
