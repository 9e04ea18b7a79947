
function height(p)
  local q = p.x > 0 and "a" or "b"
  return p.x
end
-- error: 3:13 string-choice
