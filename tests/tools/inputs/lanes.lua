-- For reports.test: control flow that is the same for all points, and that is not.
local count = param("count", 3)

function height(p)
  local sum = 0.0
  for i = 1, count do
    sum = sum + noise(p * i)
  end
  -- Too much for both sides to be computed everywhere.
  if p.x > 0.5 then
    sum = turbulence(p, 8) + fbm(p, 7)
  end
  while sum < p.y do
    sum = sum + fbm(p + sum, 3) + 1.5
  end
  return sum
end
