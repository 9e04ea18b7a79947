-- Exactly as many steps as the limit, in every kind of loop and call.
-- steps: 10
local function leaf(x) return x end
local function branch(x) return leaf(x) + leaf(x) end
function calls(frame)
  local x = branch(1) + branch(2)
  if frame > 0 then x = x + branch(3) end
  return x
end
-- run: calls frame=1
-- expect: 12
function calls_more(frame)
  local x = branch(1) + branch(2) + branch(3)
  if frame > 0 then x = x + leaf(3) end
  return x
end
-- run: calls_more frame=0
-- expect: 12
-- run: calls_more frame=1
-- expect: fault: step-limit
function broken_off(frame)
  for k = 1, 100 do
    if k == frame then break end
  end
  return frame
end
-- run: broken_off frame=9
-- expect: 9
-- run: broken_off frame=10
-- expect: fault: step-limit
function skipped(frame)
  for k = 1, frame do
    goto continue
    ::continue::
  end
  return frame
end
-- run: skipped frame=9
-- expect: 9
-- run: skipped frame=10
-- expect: fault: step-limit
function lazily(frame) return frame > 0 and leaf(1) == 1 and branch(2) == 4 end
-- run: lazily frame=1
-- expect: true
function argument_functions(frame)
  local inner = function(x) return leaf(x) end
  return inner(frame) + inner(frame) + inner(frame) + inner(frame)
end
-- run: argument_functions frame=2
-- expect: 8
