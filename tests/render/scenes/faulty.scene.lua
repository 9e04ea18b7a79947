camera { from = { 0, 5, 0 }, to = { 0, 0, 0 }, up = { 0, 0, -1 }, fov = 40 }
render { width = 32, height = 32, samples = 1 }
plane { size = 20, material = material { name = "faulty", shader = "faulty.lua" } }
