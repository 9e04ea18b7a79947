-- Marble, cut as a ball and as a block: a solid texture needs no map onto the surface.
camera { from = { 2.4, 2.1, 3.4 }, to = { 0.1, 0.62, 0 }, fov = 33 }
render { width = 960, height = 720, samples = 128, tonemap = "filmic", clamp = 12 }

local marble = material { name = "marble", shader = "marble.lua" }
local floor = material { name = "floor", color = { 0.22, 0.20, 0.19 }, roughness = 0.5 }

sphere { center = { 0.75, 0.55, 0.25 }, radius = 0.55, material = marble, name = "ball" }
box { center = { -0.65, 0.7, -0.25 }, size = { 1, 1.4, 1 }, material = marble, name = "block" }
plane { point = { 0, 0, 0 }, normal = { 0, 1, 0 }, material = floor }

light { type = "sky", zenith = { 0.20, 0.24, 0.30 }, horizon = { 0.34, 0.35, 0.37 }, ground = { 0.14, 0.13, 0.12 } }
light { type = "area", center = { 2.4, 3.6, 2.0 }, u = { 0.8, 0, -0.8 }, v = { -0.5, 0.8, -0.5 }, color = { 6, 5.7, 5.4 } }
