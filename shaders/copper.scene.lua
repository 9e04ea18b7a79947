-- A hammered copper vase with corrosion in its pits (the paper's second figure).
camera { from = { 1.7, 1.95, 3.1 }, to = { 0, 0.72, 0 }, fov = 33 }
render { width = 960, height = 720, samples = 128, tonemap = "filmic", clamp = 12 }

local copper = material { name = "copper", shader = "copper.lua" }
local table_top = material { name = "table", color = { 0.32, 0.30, 0.28 }, roughness = 0.6 }

obj { file = "vase.obj", material = copper }
plane { point = { 0, 0, 0 }, normal = { 0, 1, 0 }, material = table_top }

light { type = "sky", zenith = { 0.25, 0.34, 0.50 }, horizon = { 0.42, 0.44, 0.47 }, ground = { 0.12, 0.11, 0.10 } }
light { type = "area", center = { -2.2, 3.6, 2.4 }, u = { 0.9, 0, 0.7 }, v = { 0.5, 0.9, -0.6 }, color = { 11, 10, 9 } }
