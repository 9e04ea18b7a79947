-- A rock that noise has eroded: light finds its way by scattering within the first grains.
camera { from = { 1.6, 1.35, 2.9 }, to = { 0, 0.62, 0 }, fov = 30 }
render { width = 640, height = 360, samples = 96, depth = 6, tonemap = "filmic", exposure = -0.9, clamp = 4 }

plane { material = material { name = "floor", color = { 0.30, 0.27, 0.24 }, roughness = 0.9 } }
sphere { center = { 0, 0.66, 0 }, radius = 0.86, material = material { name = "rock", shader = "rock.lua" } }

light { type = "environment", shader = "sky.lua", rotate = 30 }
