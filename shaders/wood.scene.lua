-- Turned wood: a bowl and two spindles on a board of darker timber.
camera { from = { 0.5, 1.75, 3.3 }, to = { 0.08, 0.38, 0 }, fov = 33 }
render { width = 480, height = 360, samples = 128, depth = 5, tonemap = "filmic", exposure = 0.3, clamp = 8 }

local cherry = material { name = "cherry", shader = "wood.lua" }
local walnut = material { name = "walnut", shader = "wood.lua", params = { rings = 11, pith_height = 0.3, early = rgb(0.20, 0.105, 0.058), late = rgb(0.055, 0.026, 0.016) } }
local maple = material { name = "maple", shader = "wood.lua", params = { rings = 13, pith_height = 0.2, early = rgb(0.78, 0.60, 0.38), late = rgb(0.56, 0.34, 0.16) } }

obj { file = "bowl.obj", translate = { -0.25, 0, 0 }, material = cherry }
obj { file = "spindle.obj", translate = { 0.95, 0, -0.15 }, material = maple }
obj { file = "spindle.obj", translate = { 0.62, 0.125, 0.85 }, rotate = { 0, 25, 90 }, material = maple }
plane { material = walnut }

light { type = "area", center = { -2.6, 3.2, 1.6 }, u = { 0.9, 0, 1.1 }, v = { 0.7, 0.9, -0.5 }, color = { 9, 8.4, 7.4 } }
light { type = "sky", zenith = { 0.26, 0.29, 0.34 }, horizon = { 0.34, 0.34, 0.34 }, ground = { 0.12, 0.11, 0.10 } }
