local t = { 1, 2, x = { y = { "z" } } }
for k, v in pairs({ b = 1, a = 2, [3] = 4 }) do print(k, v) end
material { name = ("x"):rep(3), params = { scale = 8, tint = { 1, 2, 3 }, on = true, name = "a.png" } }
sphere { center = { 0 / 0, 1e308 * 10, -0.0 }, radius = math.huge, scale = { 1, 2 } }
