local t = 1
function t:scaled(x) return x end
function height(p)
  return p.x
end
-- error: 2:10 method-definition
