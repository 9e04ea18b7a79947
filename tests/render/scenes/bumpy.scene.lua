camera { from = { 1, 1.5, 4 }, to = { 0, 0.6, 0 }, fov = 40 }
render { width = 96, height = 64, samples = 8, depth = 5 }
local bumpy = material { name = "bumpy", shader = "bumpy.lua" }
sphere { center = { -0.7, 0.7, 0 }, radius = 0.7, material = bumpy }
box { center = { 0.8, 0.5, 0 }, size = 1, rotate = { 0, 30, 0 }, scale = { 1, 1.3, 1 }, material = bumpy }
plane { material = material { color = { 0.5, 0.5, 0.45 } } }
light { type = "sky", zenith = { 0.2, 0.3, 0.6 }, horizon = { 0.6, 0.6, 0.7 } }
light { type = "sun", direction = { -0.5, 0.8, 0.6 }, color = 2 }
