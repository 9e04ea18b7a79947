-- A rock that noise has eroded: light finds its way by scattering within the first grains.
camera { from = { 1.6, 1.35, 2.9 }, to = { 0, 0.62, 0 }, fov = 34 }
render { width = 640, height = 360, samples = 32, depth = 12, tonemap = "filmic", exposure = -0.7, clamp = 8 }

plane { material = material { name = "floor", color = { 0.42, 0.38, 0.34 }, roughness = 0.9 } }
sphere { center = { 0, 0.66, 0 }, radius = 0.86, material = material { name = "rock", shader = "rock.lua" } }

light { type = "environment", shader = "sky.lua", rotate = 30 }
