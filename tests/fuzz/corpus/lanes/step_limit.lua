-- Loop iterations and calls of the shader's functions count as steps, the entry among them.
-- steps: 20
function loops(frame)
  local k = 0
  while k < frame do k = k + 1 end
  return k
end
-- run: loops frame=19
-- expect: 19
-- run: loops frame=20
-- expect: fault: step-limit

local function called(x) return x + 1 end
function calls(frame)
  local x = 0
  for k = 1, frame do x = called(x) end
  return x
end
-- run: calls frame=9
-- expect: 9
-- run: calls frame=10
-- expect: fault: step-limit

function repeats(frame)
  local k = 0
  repeat k = k + 1 until k >= frame
  return k
end
-- run: repeats frame=19
-- expect: 19
-- run: repeats frame=20
-- expect: fault: step-limit

function endless(time)
  while time == time do end
  return time
end
-- run: endless time=1
-- expect: fault: step-limit
-- run: endless time=nan
-- expect: nan

function empty_loops(frame)
  for k = 1, frame do end
  repeat until true
  do end
  return frame
end
-- run: empty_loops frame=18
-- expect: 18
-- run: empty_loops frame=19
-- expect: fault: step-limit
