-- Eight octaves of noise, as colour and as bump.
local scale = param("scale", 2.0, { min = 0.01, max = 1000 })
local function grain(p) return fbm(p * scale, 8) end
function color(p) return mix(rgb(0.2, 0.15, 0.1), rgb(0.7, 0.4, 0.2), saturate(0.5 + 0.5 * grain(p))) end
function height(p) return 0.02 / scale * grain(p) end
