local t = setmetatable(1, 2)
function height(p)
  return rawlen(p) + p.x
end
-- error: 1:11 metatables
-- error: 3:10 metatables
