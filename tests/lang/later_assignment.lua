-- A variable without a value at first, assigned on every path.
function assigned_later(p)
  local x
  if p.x > 0 then x = p.y else x = p.z end
  local a, b
  a = x
  b = a * 2
  return a + b
end
-- run: assigned_later p=1,2,3
-- expect: 6

function in_loop(frame)
  local last
  local k = 0
  repeat
    last = k * k
    k = k + 1
  until k > (frame & 3)
  return last
end
-- run: in_loop frame=3
-- expect: 9
