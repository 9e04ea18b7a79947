-- Integer loops with divergent bounds, nested; counts and masks of whole lanes.
function triangle(frame, id)
  local sum = 0
  for a = 0, frame & 7 do
    for b = a, id & 7 do
      if (a ~ b) & 1 == 1 then sum = sum + (a << 4) + b else sum = sum - 1 end
    end
  end
  return sum
end
function gcd(frame, id)
  local a, b = frame, id
  while b ~= 0 do a, b = b, a % b end
  return a
end
-- run: gcd frame=48 id=36
-- expect: 12
function popcount(frame)
  local n, count = frame, 0
  while n ~= 0 do n = n & (n - 1) count = count + 1 end
  return count
end
-- run: popcount frame=-1
-- expect: 64
