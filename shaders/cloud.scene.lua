-- Clouds over a planet: a hypertexture in a shell, lit by the sun alone.
camera { from = { 1.9, 1.5, 2.4 }, to = { 0.18, 0.22, 0 }, fov = 30 }
render { width = 640, height = 360, samples = 64, depth = 24, clamp = 8 }

sphere { radius = 1, rotate = { 12, 40, 0 }, material = material { name = "planet", shader = "planet.lua" } }
sphere { radius = 1.051, material = material { name = "cloud", shader = "cloud.lua" } }

light { type = "sun", direction = { 0.9, 0.5, 0.2 }, color = { 4.4, 4.2, 4.0 } }
light { type = "sky", color = { 0.004, 0.005, 0.009 } }
