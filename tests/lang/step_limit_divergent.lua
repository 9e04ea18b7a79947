-- The limit is each point's own: lanes that reach it fault, the others go on.
-- steps: 100
function own(frame)
  local k = 0
  while k < (frame & 0xff) do k = k + 1 end
  return k
end
-- run: own frame=99
-- expect: 99
-- run: own frame=100
-- expect: fault: step-limit
local function work(n)
  local s = 0
  for k = 1, n do
    for j = 1, n do s = s + j end
  end
  return s
end
function squares(frame) return work(frame & 15) end
-- run: squares frame=9
-- expect: 405
-- run: squares frame=10
-- expect: fault: step-limit
function either(p, frame)
  if p.x > 0 then return work(8) end
  return work(frame & 7) + work(frame >> 3 & 7)
end
