local function square(x) return x * x end
local function slope(x) return gradient(square, x) end
local function bend(x) return gradient(slope, x) end
function height(p)
  return gradient(bend, p.x)
end
function density(p)
  return gradient(function(x) return fwidth(slope, x, 1) end, p.x)
end
-- error: 5:10 gradient-order
-- error: 8:10 gradient-order
