light { type = "sun", direction = { 1, 1, 0 }, color = { 1, 1, 1 }, intensity = 3, angle = 0.5 }
light { type = "sky", zenith = { 0, 0, 1 }, horizon = { 1, 1, 1 }, ground = { 0, 0, 0 } }
light { type = "point", position = { 0, 5, 0 }, color = { 1, 0.5, 0.2 }, intensity = 10 }
light { type = "area", center = { 0, 4, 0 }, u = { 1, 0, 0 }, v = { 0, 0, 1 }, color = rgb(1, 1, 1), two_sided = false }
for i = 1, 5 do sphere { center = vec3(i, math.sin(i + time), 0), radius = 0.1 * i } end
