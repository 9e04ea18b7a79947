-- A procedural sky lights and is mirrored: the surroundings are a shader, sampled by a table of its brightness.
camera { from = { 0, 0.9, 5.5 }, to = { 0, 1.35, 0 }, fov = 48 }
render { width = 640, height = 360, samples = 64, tonemap = "filmic", clamp = 16 }

plane { size = 400, material = material { name = "water", shader = "ripples.lua", params = { scale = 0.7 } } }
sphere { center = { -1.5, 0.75, 0 }, radius = 0.75, material = material { name = "chrome", color = { 0.95, 0.95, 0.95 }, metallic = 1, roughness = 0.02 }, name = "chrome" }
sphere { center = { 0.2, 0.6, 0.9 }, radius = 0.6, material = material { name = "glass", color = 1, transmission = 1, roughness = 0 }, name = "glass" }
sphere { center = { 1.7, 0.8, -0.3 }, radius = 0.8, material = material { name = "copper", shader = "copper.lua" }, name = "copper" }

light { type = "environment", shader = "sky.lua", rotate = 205 }
