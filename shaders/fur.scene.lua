-- A ball of fur: each hair is a thread of density, lit and shadowed by all the others.
camera { from = { 0, 1.5, 4.4 }, to = { 0, 0.86, 0 }, fov = 30 }
render { width = 360, height = 270, samples = 96, depth = 4, tonemap = "filmic", exposure = 0.2, clamp = 4 }

plane { material = material { name = "floor", color = { 0.36, 0.40, 0.44 }, roughness = 0.8 } }
sphere { radius = 0.97, translate = { 0, 0.95, 0 }, material = material { name = "fur", shader = "fur.lua" } }

light { type = "area", center = { -2.4, 3.4, 2.4 }, u = { 1.1, 0, 1.1 }, v = { 0.8, 1.1, -0.8 }, color = { 10, 9.4, 8.4 } }
light { type = "sky", zenith = { 0.30, 0.36, 0.46 }, horizon = { 0.42, 0.43, 0.44 }, ground = { 0.15, 0.14, 0.13 } }
