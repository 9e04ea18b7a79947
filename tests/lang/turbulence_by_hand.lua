-- The library's sums of noise, written out in the dialect.
function by_hand(p)
  local sum, weight, q = 0.0, 1.0, p
  for k = 1, 4 do
    sum = sum + weight * abs(noise(q))
    weight = weight * 0.5
    q = q * 2
  end
  return sum, turbulence(p, 4), sum - turbulence(p, 4)
end
function marble(p)
  local t, f = 0.0, 1.0
  while f < 9 do
    t = t + noise(p * f) / f
    f = f * 2
  end
  return mix(vec3(0.1, 0.2, 0.3), vec3(1), 0.5 + 0.5 * sin(p.x * 6 + t))
end
