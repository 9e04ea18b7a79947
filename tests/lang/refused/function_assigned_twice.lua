local f = function(x) return x end
f = function(x) return x * 2 end
function height(p)
  return f(p.x)
end
-- error: 2:1 function-not-known
