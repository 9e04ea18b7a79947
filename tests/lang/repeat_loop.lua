-- repeat runs its body first, and its condition sees the body's locals.
function halvings(time)
  local x, count = abs(time), 0
  repeat
    local half = x / 2
    x = half
    count = count + 1
  until half < 0.01 or count >= 40 or half ~= half
  return x, count
end
-- run: halvings time=1
-- expect: 0.0078125, 7
-- run: halvings time=0
-- expect: 0, 1

function once(frame)
  repeat frame = frame + 1 until true
  return frame
end
-- run: once frame=5
-- expect: 6

function left_by_break(frame)
  local k = 0
  repeat
    k = k + 1
    if k == (frame & 7) then break end
  until k > 5
  return k
end
-- run: left_by_break frame=3
-- expect: 3
-- run: left_by_break frame=0
-- expect: 6
