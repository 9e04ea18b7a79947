-- A planet with oceans, coasts and snow from one height function (the paper's third figure).
camera { from = { 0, 0.55, 4.2 }, to = { 0, 0, 0 }, fov = 30 }
render { width = 960, height = 720, samples = 128 }

local planet = material { name = "planet", shader = "planet.lua" }
sphere { radius = 1, material = planet, rotate = { 12, 40, 0 } }

light { type = "sun", direction = { 0.75, 0.45, 0.8 }, color = { 3.6, 3.5, 3.3 } }
light { type = "sky", zenith = { 0.004, 0.005, 0.009 }, horizon = { 0.004, 0.005, 0.009 }, ground = { 0.004, 0.005, 0.009 } }
