-- Lanes leave a loop one by one: what is read behind it must be what each had, what is read in it alone may be anything
-- for those that are gone; counters are held in 32 bits and once more for the lanes that are still there.
function escape(p)
  local x, y, n = 0.0, 0.0, 0
  while n < 40 and x * x + y * y <= 4 do
    x, y = x * x - y * y + p.x, 2 * x * y + p.y
    n = n + 1
  end
  return n
end
-- run: escape p=0.3,0.6,0
-- expect: 15

function again_and_again(p)
  local total, rounds = 0, 0
  local keep = 1.0
  for k = 1, 5 do
    local x = p.x
    local n = 100
    repeat
      x = x * 0.75 + k
      keep = keep + x
      n = n - 3
    until n < 0 or x > p.y * k
    total = total + n * k
    rounds = rounds + 1
  end
  return total, rounds, keep
end

-- `carried` is read in the inner loop alone, but lives through the turns of the outer one
function carried(p)
  local carried, sum, k = p.z, 0.0, 0
  while k < 6 do
    local n = 0
    while n < 9 do
      if carried > p.x * n then break end
      carried = carried + p.y
      n = n + 1
    end
    sum = sum + n
    k = k + 1
  end
  return sum
end

-- counted in one arm only, up and down, and from far away
function in_arms(p)
  local up, down, far = 0, 10, 2000000000
  local i = 0
  while i < 30 do
    i = i + 1
    if p.x * i < p.y then up = up + 1 else down = down - 2 end
    far = far + 1000000
    if up - down > p.z then break end
  end
  return up, down, far, i
end

-- the start differs by branch, and lanes skip the counting
function skipped(p)
  local n
  if p.x < 0 then n = 5 else n = -5 end
  local turns = 0
  for k = 1, 20 do
    if p.y * k <= 3 then
      n = n + 2
      turns = k
    end
    if n > 9 + p.z then return n, turns end
  end
  return -n, turns
end

-- an index that counts with the loop
function indexed(p)
  local weights = { 0.5, 0.25, 2, 8, 0.125, 1 }
  local sum, i = 0.0, 1
  while i <= 6 and sum < p.x do
    sum = sum + weights[i] * p.y
    i = i + 1
  end
  return sum, i
end
-- run: indexed p=1,1,0
-- expect: 2.75, 4
