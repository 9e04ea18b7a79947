-- return from within nested loops; other lanes go on.
function first_divisor(frame)
  local n = (frame & 0x3ff) + 2
  for d = 2, 100 do
    if n % d == 0 then return d end
  end
  return n
end
-- run: first_divisor frame=89
-- expect: 7
-- run: first_divisor frame=99
-- expect: 101

function deep(p)
  for a = 1, 4 do
    local b = 0
    while b < 4 do
      b = b + 1
      repeat
        if p.x * a + p.y * b > 6 then return a * 100 + b end
        if p.z > a + b then break end
      until true
    end
  end
  return 0
end
-- run: deep p=1,1,0
-- expect: 304
-- run: deep p=0,0,0
-- expect: 0

local function inner(x, limit)
  for k = 1, 30 do
    if x * k > limit then return k end
  end
  return 0
end
function through_calls(p)
  local sum = 0
  for k = 1, 3 do sum = sum + inner(p.x + k, 10) end
  return sum
end
-- run: through_calls p=1,0,0
-- expect: 13
