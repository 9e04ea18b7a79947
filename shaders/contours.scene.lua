-- A relief map seen from low above it: bump mapping and contour lines by exact derivatives.
camera { from = { 0, 1.6, 6 }, to = { 0, 0.1, 0 }, fov = 40 }
render { width = 960, height = 720, samples = 64, tonemap = "filmic" }

local map = material { name = "map", shader = "contours.lua" }

plane { point = { 0, 0, 0 }, normal = { 0, 1, 0 }, material = map }

light { type = "sky", zenith = { 0.16, 0.30, 0.55 }, horizon = { 0.80, 0.76, 0.70 }, ground = { 0.10, 0.10, 0.10 } }
light { type = "sun", direction = { -0.7, 0.5, 0.3 }, color = { 3.0, 2.7, 2.2 }, angle = 1 }
