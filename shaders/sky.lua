-- sky.lua: a sky with sun and clouds, for what is all around
local sun_height = param("sun_height", 32, { min = -10, max = 90, doc = "degrees above the horizon" })
local cover      = param("cover", 0.5, { min = 0, max = 1, doc = "share of clouds" })

local angle <const> = radians(sun_height)
local SUN   = normalize(vec3(0.55 * cos(angle), sin(angle), 0.84 * cos(angle)))
local WARM  = mix(rgb(1.0, 0.42, 0.14), rgb(1.0, 0.93, 0.82), smoothstep(0, 30, sun_height))

function environment(i)
  local up = max(i.y, 0)
  local to_sun = dot(i, SUN)
  local sky = mix(rgb(0.62, 0.70, 0.82), rgb(0.10, 0.24, 0.62), up ^ 0.45)
  sky = sky + WARM * (0.35 * saturate(to_sun) ^ 8 + 0.8 * saturate(to_sun) ^ 180)
  -- clouds on a plane high above, fading towards the horizon
  local plane = vec3(i.x, 0, i.z) / (up + 0.12)
  local amount = 0.5 + 0.5 * fbm(plane * 1.3 + vec3(3, 1, 7), 6)
  local cloud = smoothstep(1.02 - 0.8 * cover, 1.22 - 0.8 * cover, amount + 0.15) * smoothstep(0.02, 0.25, up)
  local lit = mix(rgb(0.48, 0.51, 0.57), rgb(1.05, 1.02, 0.98), smoothstep(1.5, 0.9, amount + 0.4)) + 0.5 * WARM * saturate(to_sun) ^ 12
  sky = mix(sky, lit, 0.9 * cloud)
  local disc = smoothstep(0.99980, 0.99990, to_sun) * (1 - 0.9 * cloud)
  local ground = rgb(0.22, 0.20, 0.18)
  return mix(ground, sky + 9000 * WARM * disc, smoothstep(-0.02, 0.01, i.y))
end
