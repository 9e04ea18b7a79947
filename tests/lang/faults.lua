-- assert and error end their point alone.
function checked(time)
  assert(time >= 0, "negative")
  if time > 2 then error("large") end
  return sqrt(time)
end
-- run: checked time=1
-- expect: 1
-- run: checked time=-1
-- expect: fault: assert
-- run: checked time=3
-- expect: fault: error
-- run: checked time=nan
-- expect: fault: assert

function bare(frame)
  assert(frame ~= 3)
  return frame
end
-- run: bare frame=3
-- expect: fault: assert

local function depth(x)
  if x > 1 then error("deep inside") end
  return x * 2
end
function through_calls(p)
  local sum = 0.0
  for k = 1, 3 do sum = sum + depth(p.x * k) end
  return sum, vec3(sum)
end
-- run: through_calls p=0.25,0,0
-- expect: 3, 3, 3, 3
-- run: through_calls p=0.5,0,0
-- expect: fault: error

-- the first fault counts
function order(frame, id)
  local a = frame // id
  assert(a > 100, "small")
  return a
end
-- run: order frame=1 id=0
-- expect: fault: division
-- run: order frame=1 id=1
-- expect: fault: assert
