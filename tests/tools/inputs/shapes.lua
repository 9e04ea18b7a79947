local scale = param("scale", 2.0, { min = 0.1, max = 40, step = 0.1, doc = "size of it", label = "Scale" })
local tint = param("tint", vec3(1, 0.5, 0.25))
local count = param("count", 3)
local shiny = param("shiny", false)

function color(p, n) return p * tint + n end
function height(p) return p.x * scale + count end
function counts(frame, id) return frame // id, frame + count, shiny end
function constant() return 0.1 end
