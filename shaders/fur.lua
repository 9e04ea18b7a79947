-- fur.lua: a ball of fur, a hypertexture: hairs are cells of noise on a sphere, carried outwards and combed down
local skin   = param("skin", 0.62, { min = 0.01, max = 10, doc = "radius of the ball beneath" })
local hair   = param("hair", 0.34, { min = 0, max = 10, doc = "length" })
local count  = param("count", 26, { min = 1, max = 400, doc = "hairs a radius" })
local comb   = param("comb", 0.55, { min = 0, max = 4, doc = "how far tips hang" })

-- how high above the skin, 0 to 1 at the tips, and where the hair that passes here grows
local function root(p)
  local r = length(p)
  local up = (r - skin) / hair
  local hang = comb * up * up
  local curl = 0.16 * up * vec3(noise(p * 3), noise(p * 3 + 31), noise(p * 3 + 67))
  return up, normalize(p / r + vec3(0, hang, 0) + curl)
end

function density(p)
  local up, d = root(p)
  if up < 0 then return 300 end -- the skin
  if up > 1 then return 0 end
  local f1, _, id = worley(d * count)
  local thick = 0.40 * (1 - up) + 0.04
  local long = step(up, 0.55 + 0.45 * id)
  return 300 * long * smoothstep(thick, 0.7 * thick, f1)
end

function color(p)
  local up, d = root(p)
  local coat = mix(rgb(0.62, 0.42, 0.24), rgb(0.93, 0.84, 0.70), smoothstep(0.1, 0.9, up))
  local patch = smoothstep(-0.05, 0.15, fbm(d * 1.6 + 4, 3))
  return mix(coat, coat * rgb(0.42, 0.30, 0.24), patch)
end

function anisotropy() return 0.35 end
