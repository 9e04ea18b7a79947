function height(p)
  local t = { 1, 2, 3 }
  return p.x
end
-- error: 2:13 not-available-yet
