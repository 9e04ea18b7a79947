-- while loops with divergent ends.
function collatz(frame)
  local n, count = (frame & 0xff) + 1, 0
  while n ~= 1 do
    if n % 2 == 0 then n = n // 2 else n = 3 * n + 1 end
    count = count + 1
  end
  return count
end
-- run: collatz frame=26
-- expect: 111

function mandelbrot(p)
  local zx, zy, count = 0.0, 0.0, 0
  while zx * zx + zy * zy < 4 and count < 50 do
    zx, zy = zx * zx - zy * zy + p.x, 2 * zx * zy + p.y
    count = count + 1
  end
  return count
end
-- run: mandelbrot p=0,0,0
-- expect: 50
-- run: mandelbrot p=1,1,0
-- expect: 2

function never(time)
  while time < -1000 and time > 1000 do time = time + 1 end
  while false do time = 3.0 end
  return time
end
-- run: never time=2
-- expect: 2
