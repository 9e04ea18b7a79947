-- A fire between stones: a volume that glows and lights what is around it.
camera { from = { 0, 1.5, 5.2 }, to = { 0, 0.95, 0 }, fov = 32 }
render { width = 640, height = 360, samples = 512, depth = 3, tonemap = "filmic", clamp = 2 }

plane { material = material { name = "floor", color = { 0.30, 0.26, 0.23 }, roughness = 0.8 } }
local stone = material { name = "stone", shader = "marble.lua" }
for k = 0, 8 do
  local a = k / 9 * 2 * math.pi + 0.3
  sphere { center = { 0, 0, 0 }, radius = 0.24 + 0.05 * math.sin(5 * k), translate = { 0.95 * math.cos(a), 0.12, 0.95 * math.sin(a) },
           rotate = { 40 * k, 25 * k, 0 }, scale = { 1, 0.8, 1 }, material = stone, name = "stone" .. k }
end
box { center = { 0, 1.2, 0 }, size = { 1.6, 2.4, 1.6 }, translate = { 0, 0.02, 0 }, material = material { name = "fire", shader = "fire.lua" } }

-- what volumes emit is found only by rays that cross them: a lamp in the flame spares noise
light { type = "point", position = { 0, 0.9, 0 }, color = { 2.4, 0.95, 0.26 } }
light { type = "sky", zenith = { 0.012, 0.016, 0.03 }, horizon = { 0.02, 0.022, 0.03 }, ground = { 0.01, 0.01, 0.01 } }
