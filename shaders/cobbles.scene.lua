-- Cobblestones after rain: cells of Worley's noise, with the evening sky in the water between them.
camera { from = { 0, 1.25, 2.6 }, to = { 0, 0.05, 0.35 }, fov = 40 }
render { width = 640, height = 360, samples = 128, depth = 4, tonemap = "filmic", exposure = -0.6, clamp = 8 }

plane { material = material { name = "street", shader = "cobbles.lua" } }

light { type = "environment", shader = "sky.lua", params = { sun_height = 14, cover = 0.5 }, rotate = 165 }
