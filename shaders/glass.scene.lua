-- Glass and its caustics under a lamp without extent: light that only photons find.
camera { from = { 0.2, 2.3, 4.3 }, to = { 0.1, 0.34, 0.1 }, fov = 36 }
render { width = 640, height = 360, samples = 96, depth = 14, integrator = "sppm", photons = 300000, tonemap = "filmic", clamp = 12 }

plane { material = material { name = "table", color = { 0.62, 0.58, 0.53 }, roughness = 0.8 } }
sphere { center = { -0.85, 0.6, 0.1 }, radius = 0.6, name = "ball", material = material { name = "green", color = 1, roughness = 0, transmission = 1, absorption = { 1.1, 0.12, 0.35 } } }
sphere { center = { 0.75, 0.42, 0.75 }, radius = 0.42, name = "small", material = material { name = "clear", color = 1, roughness = 0, transmission = 1 } }
box { center = { 0.8, 0.35, -0.75 }, size = { 1.3, 0.7, 0.22 }, translate = { 0, 0.01, 0 }, name = "block",
      material = material { name = "amber", color = 1, roughness = 0, transmission = 1, absorption = { 0.15, 0.9, 3.5 }, height = "pressed.lua" } }

light { type = "point", position = { -2.3, 3.1, -1.3 }, color = { 26, 25, 23 } }
light { type = "sky", color = { 0.05, 0.06, 0.08 } }
