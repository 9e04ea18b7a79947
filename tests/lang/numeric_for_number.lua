-- Numeric loops over numbers, and of mixed kinds.
function tenths()
  local count, last = 0, 0.0
  for x = 0.0, 1.0, 0.1 do count = count + 1 last = x end
  return count, last
end
-- run: tenths
-- expect: 11, 0.99999999999999989

function limit_of_point(time)
  local sum = 0.0
  for x = 0.5, time do
    sum = sum + x
    if x > 20 then break end
  end
  return sum
end
-- run: limit_of_point time=3
-- expect: 4.5
-- run: limit_of_point time=nan
-- expect: 0.5

-- integer start and step, limit a number: it is floored
function floored(time)
  local count = 0
  for k = 1, time do
    count = count + k
    if count > 100 then break end
  end
  return count
end
-- run: floored time=3.9
-- expect: 6
-- run: floored time=-1.5
-- expect: 0
-- run: floored time=inf
-- expect: 105

function downwards(time)
  local count = 0
  for k = 3, time, -1 do
    count = count + 1
    if count > 30 then break end
  end
  return count
end
-- run: downwards time=0.5
-- expect: 3
-- run: downwards time=-inf
-- expect: 31

function step_of_point(time, fw)
  local count = 0
  for x = 0.0, time, fw do
    count = count + 1
    if count >= 40 then break end
  end
  return count
end
-- run: step_of_point time=1 fw=0.25
-- expect: 5
-- run: step_of_point time=1 fw=0
-- expect: fault: for-step
