-- Each kind of light and of transparent surface, for tests that compare bits.
camera { from = { 0, 1.6, 5 }, to = { 0, 0.6, 0 }, fov = 40 }
render { width = 64, height = 40, samples = 4, depth = 8 }
plane { material = material { name = "floor", color = { 0.5, 0.45, 0.4 } } }
sphere { center = { -1.2, 0.6, 0 }, radius = 0.6, material = material { name = "lace", shader = "lace.lua" } }
sphere { center = { 1.2, 0.6, 0 }, radius = 0.6, material = material { name = "glass", color = 1, roughness = 0, transmission = 1, absorption = { 1, 0.2, 0.1 } } }
box { center = { 0, 0.3, 0.4 }, size = 0.5, rotate = { 0, 30, 0 }, material = material { name = "pane", roughness = 0, transmission = 1, thin = true } }
rectangle { center = { 0, 1.2, -1.2 }, u = { 1.5, 0, 0 }, v = { 0, 0.4, 0 }, material = material { name = "panel", shader = "glow.lua", color = 0 } }
sphere { center = { 2, 1.6, 1 }, radius = 0.2, scale = { 1, 2, 1 }, material = material { name = "bulb", emission = { 2, 2, 5 } } }
light { type = "environment", shader = "dusk.lua", intensity = 0.3 }
light { type = "spot", position = { 0, 4, 2 }, to = { 0, 0, 0 }, color = 20 }
light { type = "point", position = { -3, 2, 2 }, color = 3 }
