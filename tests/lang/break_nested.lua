-- break leaves the innermost loop only, in lanes that differ.
function pairs_below(frame)
  local limit, count = frame & 15, 0
  for a = 1, 10 do
    for b = 1, 10 do
      if a * b > limit then break end
      count = count + 1
    end
    if a > limit then break end
  end
  return count
end
-- run: pairs_below frame=6
-- expect: 14

function search(p)
  local found = -1
  local k = 0
  while true do
    if k > 20 then break end
    local x = p.x + k * 0.25
    for m = 1, 3 do
      if x * m > 3 then found = k * 10 + m break end
    end
    if found >= 0 then break end
    k = k + 1
  end
  return found
end
-- run: search p=0,0,0
-- expect: 53
