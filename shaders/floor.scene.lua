-- A floor of tiles from an image, filtered by the pixel's footprint near and far.
camera { from = { 0.4, 0.75, 2.6 }, to = { 0.1, 0.28, 0 }, fov = 42 }
render { width = 720, height = 480, samples = 96, tonemap = "filmic", clamp = 12 }

plane { size = 60, material = material { name = "floor", shader = "floor.lua" } }
sphere { center = { -0.62, 0.45, -0.2 }, radius = 0.45, material = material { name = "copper", shader = "copper.lua" }, name = "ball" }
box { center = { 0.75, 0.3, -0.35 }, size = { 0.6, 0.6, 0.6 }, material = material { name = "marble", shader = "marble.lua" }, name = "block" }

light { type = "sky", zenith = { 0.25, 0.33, 0.48 }, horizon = { 0.62, 0.62, 0.60 }, ground = { 0.12, 0.11, 0.10 } }
light { type = "area", center = { 2.6, 2.4, 1.2 }, u = { 0.5, 0, -0.8 }, v = { -0.5, 0.7, -0.4 }, color = { 14, 12.6, 10.5 } }
