local t = 1
function t:scaled(x) return x end
function height(p)
  local r = { scale = 2, scaled = function(self, x) return self.scale * x end }
  return r:scaled(p.x) + ({ x = 1 }):x()
end
-- error: 2:10 method-definition
-- error: 5:12 method-definition
-- error: 5:38 method-definition
