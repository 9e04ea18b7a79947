-- rock.lua: a boulder eroded out of a ball, a hypertexture: there is no surface, only where stone begins
local size    = param("size", 0.72, { min = 0.1, max = 1, doc = "radius of the ball" })
local erosion = param("erosion", 0.42, { min = 0, max = 1, doc = "depth of the hollows" })

-- how deep within the stone
local function depth(p)
  local strata = 0.035 * sin(34 * p.y + 5 * noise(p * 1.6))
  return size - length(p) - erosion * turbulence(p * 2.1, 5) + strata + 0.12
end

function density(p)
  return 160 * smoothstep(0, 0.02, depth(p))
end

function color(p)
  local layer = 0.5 + 0.5 * sin(26 * p.y + 6 * fbm(p * 1.8, 3))
  return mix(rgb(0.93, 0.80, 0.66), rgb(0.82, 0.56, 0.40), layer)
end
