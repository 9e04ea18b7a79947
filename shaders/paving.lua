-- paving.lua: worn square slabs in x and z
local size = param("size", 0.4, { min = 0.001, max = 100, doc = "of a slab" })

local function slab(p, fw, bevel)
  local face, id = tiles(vec2(p.x, p.z) / size, fw / size, 0.03, bevel)
  return face, mix(id, 0.5, smoothstep(0.3, 1.5, fw / size))
end

function color(p, fw)
  local face, id = slab(p, fw, 0)
  local worn = 0.5 + 0.5 * fbm(p * 6 + 40 * id, 6, 2, 0.55, fw * 6)
  return mix(rgb(0.06, 0.055, 0.05), rgb(0.34, 0.32, 0.29) * (0.6 + 0.3 * id + 0.35 * worn), face)
end

function height(p, fw)
  local face = slab(p, fw, 0.03)
  return 0.01 * face + 0.0012 * fbm(p * 30, 4, 2, 0.5, fw * 30)
end

function roughness() return 0.85 end
