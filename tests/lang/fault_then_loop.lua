-- A lane that faults stops; it neither keeps a loop going nor faults a second time.
-- steps: 2000
function stops(frame, id)
  local sum = 0
  while sum < 1000 do
    sum = sum + 100 // id
    if sum > 500 then error("large") end
    if frame > 3 then sum = sum + 1000 end
  end
  return sum
end
-- run: stops frame=4 id=1
-- expect: 1100
-- run: stops frame=0 id=0
-- expect: fault: division
-- run: stops frame=0 id=1
-- expect: fault: error
local function check(x)
  assert(x < 3, "three")
  return x
end
function in_condition(p)
  local k = 0.0
  while check(k) < p.x do k = k + 1 end
  return k
end
-- run: in_condition p=2,0,0
-- expect: 2
-- run: in_condition p=5,0,0
-- expect: fault: assert
function many_lanes(p, frame)
  local r = 0
  if frame % 4 == 0 then r = 1 // (frame & 4) elseif frame % 4 == 1 then assert(p.x > 0) else r = 3 end
  return r * 2
end
