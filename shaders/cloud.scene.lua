-- Clouds over a planet: a hypertexture in a shell, lit by the sun alone.
camera { from = { 1.9, 1.5, 2.4 }, to = { 0, 0, 0 }, fov = 37 }
render { width = 480, height = 270, samples = 256, depth = 24, tonemap = "filmic", exposure = -0.2, clamp = 4 }

sphere { radius = 1, rotate = { 12, 40, 0 }, material = material { name = "planet", shader = "planet.lua", params = { snow = 1 } } }
sphere { radius = 1.035, material = material { name = "cloud", shader = "cloud.lua" } }

light { type = "sun", direction = { 1, 0.4, 0.1 }, color = { 4.4, 4.2, 4.0 } }
