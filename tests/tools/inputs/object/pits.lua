-- For object.test: parameters of every type, values of the top level, faults, steps, C's functions.
local scale = param("scale", 4.0, { min = 0.5, max = 40, doc = "size of the dents */" })
local rings = param("rings", 3, { min = 1, max = 9 })
local sharp = param("sharp", true)
local tint = param("class", rgb(0.25, 0.5, 1))
local unused = param("unused", 2.5)

local mode = param("mode", "plain", { choices = { "plain", "odd \"?\"", "deep" } })

local phase = math.sin(scale) * 2

function height(p)
  local sum = 0.0
  local i = 0
  while i < rings do
    sum = sum + noise(p * scale) / (i + 1)
    i = i + 1
  end
  if mode == "deep" then sum = sum * 2 elseif mode == 'odd "?"' then sum = -sum end
  return sharp and math.floor(sum * 4) / 4 + phase or sum
end

function shade(p, uv, frame, backface)
  assert(p.x < 0.75, "too far")
  local s = math.sin(p.y) ^ 3 + 7 // frame
  local n = 0
  while p.z > 0.5 and n < 2000000 do -- too many steps for these points alone
    n = n + 1
  end
  return tint * s + (backface and 1 or 0), n, p.x > uv.x
end

function instantiate(p) -- a name of the interface's own
  return p.x
end
