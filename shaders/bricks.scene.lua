-- A brick wall that runs away from the eye: at its end a pixel holds many courses, and there is no moiré.
camera { from = { -2.2, 0.95, 1.25 }, to = { 2.2, 0.62, -0.5 }, fov = 46 }
render { width = 640, height = 360, samples = 96, depth = 4, tonemap = "filmic", exposure = -0.25 }

plane { normal = { 0, 0, 1 }, material = material { name = "wall", shader = "bricks.lua" } }
plane { material = material { name = "pavement", shader = "paving.lua" } }

light { type = "sky", zenith = { 0.14, 0.26, 0.55 }, horizon = { 0.60, 0.60, 0.62 }, ground = { 0.1, 0.1, 0.1 } }
light { type = "sun", direction = { -0.6, 0.62, 0.62 }, color = { 3.4, 2.8, 2.0 }, angle = 0.8 }
