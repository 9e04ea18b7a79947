-- noise.lua: simplex noise, once
function height(p)
  return noise(p)
end
