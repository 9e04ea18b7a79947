-- rock.lua: a boulder eroded out of a ball, a hypertexture: there is no surface, only where stone begins
local size    = param("size", 0.78, { min = 0.1, max = 1, doc = "radius of the ball" })
local erosion = param("erosion", 0.26, { min = 0, max = 1, doc = "depth of the hollows" })

-- how deep within the stone
local function depth(p)
  local strata = 0.03 * sin(30 * p.y + 5 * noise(p * 1.6))
  return size - length(p) - erosion * turbulence(p * 2.1, 5) + strata
end

function density(p)
  return 400 * smoothstep(0, 0.01, depth(p))
end

function color(p)
  local layer = 0.5 + 0.5 * sin(26 * p.y + 6 * fbm(p * 1.8, 3))
  return mix(rgb(0.82, 0.70, 0.58), rgb(0.66, 0.44, 0.32), layer)
end
