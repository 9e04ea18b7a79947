-- Calls within calls under masks; each level returns early for other lanes.
local function third(x, k)
  if x > k then return x - k end
  for j = 1, 4 do
    if x + j > k then return j * 10 + x end
    if j == 3 then return -j end
  end
  return 0
end
local function second(v, k)
  if v.x < 0 then return third(-v.x, k) end
  local s = 0.0
  while s < 3 do
    s = s + third(v.y + s, k) * 0.125 + 0.5
    if s > 2.5 then return s end
  end
  return s + v.z
end
function first(p)
  local total = 0.0
  for k = 1, 4 do
    if p.z > k then goto continue end
    total = total + second(p + k, k)
    if total > 20 then return total, k end
    ::continue::
  end
  return total, 0
end
function twice(p) return second(p, 1) + second(p.zyx, second(p.yzx, 2)) end
