-- cobbles.lua: a street of round stones in x and z, cells of Worley's noise, with water standing between them
local size  = param("size", 0.26, { min = 0.001, max = 100, doc = "of a stone" })
local water = param("water", 0.5, { min = 0, max = 1, doc = "how high it stands" })

local STONES <const> = { rgb(0.16, 0.15, 0.15), rgb(0.27, 0.24, 0.21), rgb(0.12, 0.135, 0.16), rgb(0.32, 0.25, 0.19) }

-- how high a stone stands, 0 at its border to 1, and a number of its own
local function stone(p)
  local f1, f2, id = worley(vec2(p.x, p.z) / size)
  local edge = saturate(1.6 * (f2 - f1))
  return (1 - (1 - edge) * (1 - edge) * (1 - edge)) * (1 - 0.4 * f1 * f1), id
end

-- 0 on dry stone to 1 where water covers it
local function wet(p)
  local dome, id = stone(p)
  local low = fbm(vec2(p.x, p.z) * 0.8, 3) -- puddles lie where the street has sunk
  local level = water * (1 + 1.6 * low)
  return smoothstep(level + 0.05, level - 0.05, dome * (0.8 + 0.3 * id))
end

-- what of it the footprint still shows
local function detail(fw) return smoothstep(1, 0.2, fw / size) end

function height(p, fw)
  local dome, id = stone(p)
  local rough = 0.003 * fbm(p * 30 + 20 * id, 4, 2, 0.5, fw * 30)
  return detail(fw) * (1 - wet(p)) * (0.28 * size * dome + rough)
end

function color(p, fw)
  local dome, id = stone(p)
  local rock = STONES[math.min(math.floor(id * 4), 3) + 1] * (0.85 + 0.3 * fbm(p * 40 + 20 * id, 4, 2, 0.5, fw * 40))
  local dirt = smoothstep(0.55, 0.15, dome)
  return mix(mix(rock, rgb(0.05, 0.045, 0.04), dirt), rgb(0.02, 0.022, 0.02), 0.8 * wet(p))
end

function roughness(p, fw)
  return mix(0.5, 0.05, wet(p) * detail(fw))
end
