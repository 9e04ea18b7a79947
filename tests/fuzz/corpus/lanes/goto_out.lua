-- goto to a label behind enclosing blocks: leaves nested loops.
function find(p)
  local a, b = 0, 0
  for x = 1, 6 do
    for y = 1, 6 do
      if p.x * x + p.y * y > 5 then
        a, b = x, y
        goto found
      end
    end
  end
  ::found::
  return a, b
end
-- run: find p=1,1,0
-- expect: 1, 5
-- run: find p=0,0,0
-- expect: 0, 0

function over_blocks(time)
  local x = 1.0
  do
    if time > 1 then goto done end
    x = 2.0
    do
      if time > 0 then goto done end
      x = 3.0
    end
    x = x + 0.5
  end
  ::done::
  return x
end
-- run: over_blocks time=2
-- expect: 1
-- run: over_blocks time=0.5
-- expect: 2
-- run: over_blocks time=-1
-- expect: 3.5
