-- Volumes in a sphere and in boxes that overlap, before a wall, for tests that compare bits.
camera { from = { 0, 1.2, 5 }, to = { 0, 0.8, 0 }, fov = 40 }
render { width = 64, height = 40, samples = 4, depth = 8 }
plane { material = material { name = "floor", color = { 0.5, 0.45, 0.4 } } }
sphere { center = { -0.9, 1, 0 }, radius = 1, material = material { name = "puff", shader = "puff.lua" } }
box { center = { 0.9, 0.9, 0 }, size = { 1.2, 1.4, 1 }, rotate = { 0, 20, 0 }, material = material { name = "haze", density = 1.5, color = { 0.8, 0.9, 1 }, anisotropy = 0.6 } }
box { center = { 1.2, 0.6, 0.4 }, size = 0.8, material = material { name = "smoke", density = 4, color = 0.2 } }
light { type = "sun", direction = { 0.5, 1, 0.6 }, color = 3 }
light { type = "sky", intensity = 0.4 }
