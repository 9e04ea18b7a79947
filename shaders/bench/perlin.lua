-- perlin.lua: improved Perlin noise, once
function height(p)
  return perlin(p)
end
