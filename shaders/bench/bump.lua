-- bump.lua: the slope of a height of four octaves of simplex noise, exactly and by differences
local STEP <const> = 1 / 1024

function height(p)
  local sum, weight = 0.0, 1.0
  for _ = 1, 4 do
    sum = sum + weight * noise(p)
    p, weight = p * 2, weight * 0.5
  end
  return sum
end

function slope(p)
  return gradient(height, p)
end

function differences(p)
  local x, y, z = vec3(STEP, 0, 0), vec3(0, STEP, 0), vec3(0, 0, STEP)
  return vec3(height(p + x) - height(p - x),
              height(p + y) - height(p - y),
              height(p + z) - height(p - z)) / (2 * STEP)
end
