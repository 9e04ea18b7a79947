-- A fault under a mask hits only the lanes there; lanes that are off do not fault.
function guarded(frame, id)
  local r = -1
  if id ~= 0 then
    r = frame // id
    if r == 2 then r = r // (id - id) end
  end
  return r
end
-- run: guarded frame=4 id=0
-- expect: -1
-- run: guarded frame=4 id=2
-- expect: fault: division
-- run: guarded frame=4 id=4
-- expect: 1

function in_loop(frame)
  local sum = 0
  for k = 0, 8 do
    if k == (frame & 15) then break end
    sum = sum + 60 // (k - 5)
  end
  return sum
end
-- run: in_loop frame=3
-- expect: -47
-- run: in_loop frame=9
-- expect: fault: division
