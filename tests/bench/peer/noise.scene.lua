-- bunny.scene.lua with eight octaves of noise on everything, as colour and as bump.
camera { from = { 0, 1.2, 4 }, to = { 0, 0.8, 0 }, fov = 23.14091714057779 }
render { width = 1280, height = 720, samples = 16, depth = 6 }
light { type = "sky", zenith = { 0.6, 0.7, 0.9 }, horizon = { 0.6, 0.7, 0.9 }, ground = { 0.6, 0.7, 0.9 } }
light { type = "area", center = { 0, 4, 0 }, u = { 1, 0, 0 }, v = { 0, 0, 1 }, two_sided = false, color = 6 }
rectangle { u = { 10, 0, 0 }, v = { 0, 0, -10 }, material = material { ior = 1, shader = "noise.lua" } }
obj { file = "bunny.obj", translate = { 0.1, -0.33, 0 }, scale = 10,
      material = material { ior = 1, shader = "noise.lua", params = { scale = 20 } } }
