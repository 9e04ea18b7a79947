-- pressed.lua: glass that has been poured: shallow waves
local amount = param("amount", 0.012, { min = 0, max = 1, doc = "height of the waves" })

function height(p)
  return amount * fbm(p * vec3(4, 4, 4), 2)
end
