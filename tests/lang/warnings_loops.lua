-- Loops that only the exact equality of two numbers ends. Integers, other conditions and other ways out are all right.
-- steps: 50
function height(p)
  local x = 0.0
  while x ~= 1.0 do
    x = x + 0.25
  end
  repeat x = x + 0.5 until x == 3
  repeat x = x + 0.5 until not (x ~= 4.0) and p.x == p.x
  while not (p.x * 0 + 1 == 1) or x ~= 5 do x = x + 1 end
  local v = vec2(0, 0)
  while v ~= vec2(2, 2) do v = v + 1 end

  local i = 0
  while i ~= 3 do i = i + 1 end
  while x ~= 6.0 and i < 10 do
    i = i + 1
    x = x + 1
  end
  repeat
    i = i + 1
    x = x + 1
  until x == 7.0 or i > 20
  while x ~= 8.0 do
    x = x + 0.5
    if x > 20 then break end
  end
  while x ~= 9.0 do
    x = x + 0.5
    if x > 20 then return x end
  end
  while x < 20 do x = x + 1 end
  return x + v.x + i
end
-- run: height p=1,2,3
-- expect: 27
-- warning: 5:9 float-equality-loop
-- warning: 8:28 float-equality-loop
-- warning: 9:33 float-equality-loop
-- warning: 10:14 float-equality-loop
-- warning: 12:9 float-equality-loop
