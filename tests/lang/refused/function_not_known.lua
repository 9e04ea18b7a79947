local function f(x) return x end
local function g(x) return x * 2 end
function height(p)
  local h = p.x > 0 and f or g
  return h(p.x)
end
-- error: 4:13 function-not-known
