-- Library calls under masks, with arguments of switched-off lanes that are anything.
function guarded(p)
  local r = 0.0
  if p.x > 0 then r = log(p.x) + sqrt(p.x) end
  if p.y > 1 then r = r + acos(1 / p.y) elseif p.y < -1 then r = r + pow(-p.y, 2.5) end
  for k = 1, 5 do
    if p.z * k > 3 then break end
    r = r + perlin(p * k) + (k < 3 and hash(p * k) or 0.25)
  end
  return r
end
function integers(p)
  if abs(p.x) < 1000 then return math.floor(p.x * 4) & 3, math.ceil(p.x) end
  return -1, 0
end
-- run: integers p=-1.3,0,0
-- expect: 2, -1
