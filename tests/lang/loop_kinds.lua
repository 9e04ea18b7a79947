-- The kind of a loop's variable follows from start and step alone; the limit is only compared with.
function kinds()
  local a, b, c = 0.0, 0.0, 0
  for x = 1, 2, 0.5 do a = a + x end
  for x = 1.0, 3 do b = b + x / 2 end
  for k = 1, 3.9 do c = c + k // 2 end
  return a, b, c
end
-- run: kinds
-- expect: 4.5, 3, 2
function from_point(frame, time)
  local s, n = 0.0, 0
  for x = frame, time, 0.25 do
    s = s + x
    n = n + 1
    if n > 20 then break end
  end
  return s, n
end
-- run: from_point frame=1 time=2
-- expect: 7.5, 5
function downwards_by_number(time)
  local n = 0
  for x = 2, time, -0.5 do
    n = n + 1
    if n > 30 then break end
  end
  return n
end
-- run: downwards_by_number time=0
-- expect: 5
function integer_limits(time)
  local n = 0
  for k = math.maxinteger - 3, time do n = n + 1 end
  for k = math.mininteger + 3, time, -1 do n = n + 100 end
  return n
end
-- run: integer_limits time=inf
-- expect: 4
-- run: integer_limits time=-inf
-- expect: 400
-- run: integer_limits time=nan
-- expect: 400
function last_value(frame)
  local last = 0
  for k = 0, frame & 63, 7 do last = k end
  return last
end
-- run: last_value frame=20
-- expect: 14
