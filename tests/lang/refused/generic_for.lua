local function iterate(a, b) return b end
function height(p)
  for k in iterate, 1, 2 do end
  return p.x
end
-- error: 3:12 generic-for
