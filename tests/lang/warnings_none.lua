-- An ordinary shader has no warnings.
-- no warnings
local scale = param("scale", 4.0)
local tint = rgb(0.5, 0.25, 1)

local function layers(p, count)
  local sum, weight = 0.0, 1.0
  for _ = 1, count do
    sum = sum + weight * noise(p)
    p, weight = p * 2, weight / 2
  end
  return sum
end

function height(p)
  return layers(p * scale, 3)
end

function color(p, n)
  local h = height(p)
  if h > 0 then return tint * h end
  return n * 0.5 + 0.5
end
