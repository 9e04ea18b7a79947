-- copper.lua: hammered copper, with corrosion in the pits of its bump
local scale     = param("scale", 2.2, { min = 0.1, max = 40, doc = "dents a unit of length" })
local depth     = param("depth", 0.06, { min = 0, max = 1, doc = "depth of the dents" })
local corrosion = param("corrosion", 0.85, { min = 0, max = 1, doc = "how green the pits are" })

local COPPER    <const> = rgb(0.83, 0.43, 0.24)
local TARNISH   <const> = rgb(0.32, 0.13, 0.07)
local VERDIGRIS <const> = rgb(0.17, 0.47, 0.38)

-- 0 on the hammered face, falling to -1 at the bottom of a pit
local function relief(p)
  return -smoothstep(0.15, 1.05, turbulence(p * scale, 4))
end

-- how much of the metal the corrosion has eaten, 0 to 1
local function patina(p)
  local pit = smoothstep(-0.25, -0.55, relief(p))
  return corrosion * pit * smoothstep(-0.4, 0.5, noise(p * scale * 1.7) + 0.35)
end

function height(p)
  return depth * relief(p)
end

function color(p)
  local metal = mix(COPPER, TARNISH, smoothstep(-0.08, -0.4, relief(p)))
  local crust = VERDIGRIS * (0.8 + 0.35 * noise(p * scale * 9))
  return mix(metal, crust, patina(p))
end

function metallic(p)
  return 1 - patina(p)
end

function roughness(p)
  return mix(0.42, 0.95, patina(p))
end
