-- fire.lua: a flame, p.y up from its root at 0; the box around it holds -0.8..0.8, 0..2.4, -0.8..0.8
local speed = param("speed", 1.6, { min = 0, max = 10, doc = "how fast it rises" })
local rage  = param("rage", 0.34, { min = 0, max = 1, doc = "how far it flickers" })

-- how hot: 1 in the core, 0 outside
local function heat(p, time)
  local y = p.y
  local q = vec3(p.x, y - speed * time, p.z) * 1.9
  local sway = rage * (0.25 + 0.75 * y) * vec3(noise(q), 0, noise(q + 19))
  local s = p + sway
  local width = 0.42 * smoothstep(-0.05, 0.35, y) * (1 - 0.36 * y)
  local d = length(vec2(s.x, s.z)) / max(width, 0.02)
  local lick = 0.45 * fbm(q * 1.8, 4)
  return saturate(1.15 - d * d + lick - 0.22 * y) * smoothstep(0, 0.12, y) * smoothstep(2.35, 1.6, y)
end

function density(p, time)
  return 1.6 * heat(p, time)
end

function color(p)
  return rgb(0.25, 0.22, 0.2) -- soot
end

function emission(p, time)
  local t = heat(p, time)
  local glow = mix(rgb(1.6, 0.16, 0.01), rgb(1.5, 0.9, 0.35), smoothstep(0.25, 0.9, t))
  return 9 * t * t * glow
end
