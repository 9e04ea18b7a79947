-- Ends that cannot be reached: behind error, in loops that only return leaves.
local function one_of(x)
  if x > 1 then return 1 elseif x > 0 then return 2 else return 3 end
end
function chosen(time) return one_of(time) end
-- run: chosen time=0.5
-- expect: 2
function until_found(frame)
  local k = 0
  while true do
    k = k + 1
    if k * k > (frame & 0xff) then return k end
  end
end
-- run: until_found frame=80
-- expect: 9
function from_do(p)
  do
    local x = p.x
    if x > 0 then return x else return -x end
  end
end
-- run: from_do p=-2,0,0
-- expect: 2
