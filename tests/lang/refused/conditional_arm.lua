-- in a chain every part but the last is 'c and a'
function height(p)
  local x = p.x > 0 and 2 or p.y or 3
  local y = p.x > 0 and 1 or p.y > 0 and 2 or 3
  return x + y
end
-- error: 3:30 conditional-arm
