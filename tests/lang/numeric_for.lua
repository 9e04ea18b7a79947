-- Numeric loops over integers: steps, empty ranges, and ends at the edges of the integers.
function sum_to(frame)
  local sum = 0
  for k = 1, frame do sum = sum + k if k >= 1000 then break end end
  return sum
end
-- run: sum_to frame=10
-- expect: 55
-- run: sum_to frame=-3
-- expect: 0

function steps(id)
  local sum, count = 0, 0
  for k = 10, -10, -3 do sum = sum + k * id count = count + 1 end
  for k = 1, 2, 5 do sum = sum + 100 * k end
  for k = 2, 1 do sum = sum + 100000 * k end
  return sum, count
end
-- run: steps id=1
-- expect: 107, 7

function edges()
  local count = 0
  for k = math.maxinteger - 2, math.maxinteger do count = count + 1 end
  for k = math.mininteger + 2, math.mininteger, -1 do count = count + 10 end
  for k = math.mininteger, math.maxinteger, math.maxinteger do count = count + 100 end
  return count
end
-- run: edges
-- expect: 333

function step_of_point(frame, id)
  local count = 0
  for k = 0, frame, id do
    count = count + 1
    if count == 50 then break end
  end
  return count
end
-- run: step_of_point frame=10 id=3
-- expect: 4
-- run: step_of_point frame=-10 id=-3
-- expect: 4
-- run: step_of_point frame=10 id=0
-- expect: fault: for-step
