-- Images: constant names and a parameter's, relative to this file; a module's relative to its own.
local file = param("file", "images/colours.png", { doc = "an image" })
local pictures = require "modules.pictures"

function looked_up(uv, fw) return texture("images/colours.png", uv), texture("images/colours.png", uv, fw), texture(file, uv) end
function kinds(uv, fw)
  return texture("images/grey_alpha.png", uv, { raw = true }), texture("images/colours.png", uv, fw, { raw = true }),
    texture("images/linear.exr", uv, fw), texture("images/odd.png", uv * 3, fw)
end
function of_module(uv) return pictures.look(uv), pictures.look_again(uv) end
-- Divided lanes, loops, and what is the same for all.
function divided(uv, p)
  local sum = vec4(0)
  if p.x > 0 then sum = texture(file, uv) elseif p.y > 0 then sum = texture("images/odd.png", p.xy, 0.2) end
  for i = 1, 3 do if uv.x * i > 0.5 then sum = sum + texture("images/odd.png", uv * i) end end
  return sum, texture("images/odd.png", vec2(0.25, 0.75))
end
local CORNER <const> = texture("images/colours.png", vec2(0.125, 0.875))
function at_top_level(p) return CORNER.rgb * p.x end

-- Texels of 4 by 4: row 0 is the top one. sRGB 255 is 1, 0 is 0, 128 is 0.2159.
-- run: looked_up uv=0.125,0.875 fw=0
-- expect: 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1
-- run: looked_up uv=1.125,-2.125 fw=-3
-- expect: 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1
-- run: of_module uv=0.25,0.75
-- expect: 0, 0, 0, 1, 0, 0, 0, 1
-- run: of_module uv=0.75,0.75
-- expect: 1, 1, 1, 1, 1, 1, 1, 1
-- run: kinds uv=0.0625,0.9375 fw=0
-- expect: 0, 0, 0, 1, 0.75, 0.1875, 0.1875, 1, 1.5625, 0.1875, -0.25, 1, 0.093768663704395294, 0.022674582898616791, 0.10401520133018494, 0.93137252330780029
