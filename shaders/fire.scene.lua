-- A fire between stones: a volume that glows and lights what is around it, and nothing else does.
camera { from = { 0, 1.6, 5.0 }, to = { 0, 0.9, 0 }, fov = 30 }
render { width = 480, height = 270, samples = 256, depth = 4, tonemap = "filmic", exposure = 0.6, clamp = 4 }

plane { size = 40, material = material { name = "floor", color = { 0.30, 0.26, 0.23 }, roughness = 0.8 } }
local stone = material { name = "stone", shader = "marble.lua" }
for k = 0, 8 do
  local a = k / 9 * 2 * math.pi + 0.3
  sphere { radius = 0.24 + 0.05 * math.sin(5 * k), translate = { 0.95 * math.cos(a), 0.12, 0.95 * math.sin(a) },
           rotate = { 40 * k, 25 * k, 0 }, scale = { 1, 0.8, 1 }, material = stone, name = "stone" .. k }
end
box { center = { 0, 1.2, 0 }, size = { 1.6, 2.4, 1.6 }, translate = { 0, 0.02, 0 }, material = material { name = "fire", shader = "fire.lua" } }
