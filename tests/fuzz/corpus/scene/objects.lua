camera { from = { 0, 2, 6 }, to = { 0, 1, 0 }, up = { 0, 1, 0 }, fov = 40 }
render { width = 64, height = 48, samples = 4, seed = 1, depth = 3, integrator = "whitted", exposure = 1, tonemap = "filmic", clamp = 4 }
local m = material { name = "m", color = { 0.5, 0.4, 0.3 }, roughness = 0.5, metallic = 0, ior = 1.3 }
sphere { center = { 0, 1, 0 }, radius = 1, material = m }
rectangle { center = { 0, 0, 0 }, u = { 1, 0, 0 }, v = { 0, 0, 1 }, material = m, scale = 2, rotate = { 0, 45, 0 }, translate = { 1, 0, 0 } }
plane { point = { 0, -1, 0 }, normal = { 0, 1, 0 }, size = 50 }
box { center = { 2, 1, 0 }, size = { 1, 1, 1 }, material = m }
