-- the hash of an integer is another one than that of the number, where it is large
function height(p)
  local k = 16777217
  if p.x > 0 then k = k + p.y end
  return hash(k) + hash(3) + hash(p.x)
end
-- error: 5:15 mixed-number
