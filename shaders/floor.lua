-- floor.lua: an encaustic floor from one image: its colours, and in alpha the height that bends the normal
local file = param("file", "floor.png", { doc = "an image that repeats: colours, and in alpha heights" })
local tile = param("tile", 0.8, { min = 0.01, max = 100, doc = "side of the image, in the units of p" })
local depth = param("depth", 0.01, { min = 0, max = 1, doc = "of the joints, in sides of the image" })

-- Of a footprint that is wider than a texel the image gives its mean, so that distant tiles do not flicker.
local function look(p, fw) return texture(file, p.xz / tile, fw / tile) end

function height(p, fw) return depth * tile * look(p, fw).w end
function color(p, fw) return look(p, fw).rgb end
-- Worn where it is high.
function roughness(p, fw) return mix(0.75, 0.22, smoothstep(0.35, 0.85, look(p, fw).w)) end
