-- wood.lua: a solid texture, so that whatever is turned from the log shows its rings where the tool has cut them
local rings = param("rings", 15, { min = 0.1, max = 200, doc = "a unit of length" })
local pith  = param("pith_height", 0.9, { min = -100, max = 100, doc = "of the log's middle, which lies along x" })
local early = param("early", rgb(0.66, 0.40, 0.20), { doc = "colour of spring's wood" })
local late  = param("late", rgb(0.27, 0.115, 0.045), { doc = "colour of autumn's" })

-- the log's own coordinates: its axis is y, and it has grown a little crooked
local function log_of(p)
  local bend = 0.05 * vec3(0, noise(vec3(p.x * 0.7, 3, 5)), noise(vec3(p.x * 0.7, 9, 1)))
  local q = p + bend - vec3(0, pith, 0.25)
  return vec3(q.y, q.x, q.z)
end

-- 0 in spring to 1 at the end of a year
local function year(p, fw)
  return wood(log_of(p) * rings, fw * rings, 0.55, 0.12)
end

-- short dark pores along the fibre
local function pores(p, fw)
  local q = log_of(p)
  return smoothstep(0.45, 0.75, noise(vec3(q.x * 130, q.y * 7, q.z * 130))) * smoothstep(0.02, 0.005, fw)
end

function color(p, fw)
  local board = 0.5 + 0.5 * fbm(log_of(p) * vec3(3, 0.4, 3), 3)
  local timber = mix(early, late, 0.85 * year(p, fw)) * (0.8 + 0.4 * board)
  return timber * (1 - 0.45 * pores(p, fw))
end

function height(p, fw)
  return -0.0012 * pores(p, fw)
end

function roughness(p, fw)
  return 0.28 + 0.12 * year(p, fw)
end
