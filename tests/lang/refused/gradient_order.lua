local function square(x) return x * x end
local function slope(x) return gradient(square, x) end
function height(p)
  return gradient(slope, p.x)
end
-- error: 4:10 gradient-order
