-- Surfaces that only scatter diffusely, under each kind of light that is sampled many points at once, for tests that compare bits.
camera { from = { 1, 1.5, 4 }, to = { 0, 0.6, 0 }, fov = 40 }
render { width = 96, height = 64, samples = 8, depth = 8 }
rectangle { u = { 6, 0, 0 }, v = { 0, 0, -6 }, material = material { name = "floor", ior = 1, shader = "waves.lua" } }
sphere { center = { -0.7, 0.7, 0 }, radius = 0.7, material = material { name = "red", ior = 1, color = "tinted.lua" } }
box { center = { 0.8, 0.5, 0 }, size = 1, rotate = { 0, 30, 0 }, material = material { name = "white", ior = 1, color = 0.9 } }
light { type = "area", center = { 0, 3, 0 }, u = { 1, 0, 0 }, v = { 0, 0, 1 }, two_sided = false, color = 6 }
light { type = "sky", zenith = { 0.2, 0.3, 0.6 }, horizon = { 0.6, 0.6, 0.7 } }
light { type = "sun", direction = { -0.5, 0.8, 0.6 }, color = 2 }
light { type = "point", position = { 2, 2, 2 }, color = 5 }
