-- The loop's variable is a fresh local of each turn; assigning it changes nothing of the loop.
function assigned()
  local sum = 0
  for k = 1, 5 do
    k = k * 10
    sum = sum + k
  end
  return sum
end
-- run: assigned
-- expect: 150

function shadowed(frame)
  local k, sum = 7, 0
  for k = 1, 3 do
    local k = k + frame
    sum = sum + k
  end
  return sum + k
end
-- run: shadowed frame=10
-- expect: 43

function limits_once(frame)
  local limit, sum = 3, 0
  for k = 1, limit do
    limit = limit + 100
    sum = sum + k
  end
  return sum + limit + frame
end
-- run: limits_once frame=0
-- expect: 309
