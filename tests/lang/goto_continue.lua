-- goto continue, in every kind of loop.
function odd_sum(frame)
  local sum = 0
  for k = 1, frame & 31 do
    if k % 2 == 0 then goto continue end
    if k == 13 then goto continue end
    sum = sum + k
    ::continue::
  end
  return sum
end
-- run: odd_sum frame=15
-- expect: 51

function in_while(p)
  local k, sum = 0, 0.0
  while k < 10 do
    k = k + 1
    if p.x * k < 2 then goto continue end
    sum = sum + k * p.y
    ::continue::
  end
  return sum
end
-- run: in_while p=0.5,1,0
-- expect: 49

function in_repeat(frame)
  local k, sum = 0, 0
  repeat
    k = k + 1
    if (frame >> k) & 1 == 0 then goto continue end
    sum = sum + k
    ::continue::
  until k >= 12
  return sum
end
-- run: in_repeat frame=10
-- expect: 4

function nested(frame)
  local count = 0
  for a = 1, 5 do
    for b = 1, 5 do
      if (a + b + frame) % 3 == 0 then goto next_b end
      if a == b then goto next_a end
      count = count + a * b
      ::next_b::
    end
    ::next_a::
  end
  return count
end
-- run: nested frame=0
-- expect: 77
