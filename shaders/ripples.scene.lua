-- Reflections on a bumpy surface (the paper's first figure): three shaded balls over dark, rippled water.
camera { from = { 0, 1.15, 5.2 }, to = { 0, 0.55, 0 }, fov = 38 }
render { width = 960, height = 720, samples = 128, tonemap = "filmic", clamp = 12 }

local water = material { name = "water", shader = "ripples.lua" }
local copper = material { name = "copper", shader = "copper.lua" }
local marble = material { name = "marble", shader = "marble.lua" }
local planet = material { name = "planet", shader = "planet.lua" }

plane { point = { 0, 0, 0 }, normal = { 0, 1, 0 }, material = water }
sphere { center = { -1.35, 0.85, -0.1 }, radius = 0.62, material = copper, name = "copper" }
sphere { center = { 0, 0.95, -0.6 }, radius = 0.62, material = planet, name = "planet" }
sphere { center = { 1.35, 0.85, -0.1 }, radius = 0.62, material = marble, name = "marble" }

light { type = "sky", zenith = { 0.10, 0.20, 0.42 }, horizon = { 0.75, 0.66, 0.56 }, ground = { 0.10, 0.10, 0.10 } }
light { type = "sun", direction = { -0.6, 0.55, 0.65 }, color = { 3.2, 2.8, 2.3 }, angle = 2 }
