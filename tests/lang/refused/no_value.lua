local function nothing(x) local y = x end
function height(p)
  local a = nothing(p.x)
  return p.x + nothing(p.y)
end
-- error: 4:16 no-value
