-- gradient and fwidth: of the shader's functions by name, of functions written there, of the library's; by numbers and
-- vectors of each size; with captures, loops and branches.
-- mild
-- near: 1e-6
local scale = param("scale", 1.5)
local offset = vec3(0.1, -0.2, 0.3)

local function wave(q)
  return sin(q.x * scale) * q.y + cos(q.z)
end

function height(p)
  return 0.2 * noise(p * 1.5 + offset) + 0.1 * fbm(p, 3)
end

function normal_of(p, n)
  return normalize(n - gradient(height, p))
end

function by_number(p, time)
  local t = time * 0.5
  local function ramp(x) return x ^ 3 + t * x end
  return gradient(ramp, p.x), gradient(sin, p.y), gradient(function(x) return exp(-x * x) * t end, p.z)
end

function by_integer(frame)
  return gradient(function(x) return x * x end, frame), gradient(function(x) return x // 1 + 0.5 * x end, frame + 0.5)
end

function by_vectors(p, uv)
  local a = gradient(function(q) return q.x * q.x * q.y end, uv)
  local b = gradient(wave, p)
  local c = gradient(function(q) return dot(q, q) * 0.5 + q.w end, vec4(p, 2))
  return a, b, c, gradient(noise, p), gradient(fbm, uv), gradient(perlin, p.x)
end

function controlled(p, time)
  local k = time
  local g = gradient(function(q)
    local s, r = 0.0, q
    for i = 1, 4 do
      if i == 3 then goto continue end
      s = s + r.x * k
      r = r * 0.75 + vec3(s, r.z, 0)
      ::continue::
    end
    if q.x + k > 10 then return s end
    local n = 0
    while n < 3 do
      n = n + 1
      s = s + q.z / n
      if s > 100 then break end
    end
    return s * (q.y > 50 and q.x or q.y)
  end, p)
  return g
end

-- The function's own locals may be assigned by functions inside it.
function inside(p)
  return gradient(function(q)
    local sum = 0.0
    local function add(x) sum = sum + x * x end
    add(q.x)
    add(q.y)
    return sum
  end, p)
end

function footprint(p, uv, fw, time)
  local w = fwidth(function(x) return x * time end, p.x, fw)
  return w, fwidth(height, p, fw), aastep(0.1, p.x, fwidth(function(q) return q.x end, p, fw)), fwidth(fbm, uv, -0.5)
end

function constants(p)
  return gradient(function(q) return 3 end, p), gradient(function() return 2.5 end, p),
         gradient(function(q) return math.floor(q.x * 0 + 0.5) end, p), gradient(floor, 0.5)
end

local at_top = gradient(function(x) return x * x end, 3)
function from_top()
  return at_top
end

-- run: by_integer frame=3
-- expect: 6, 0.5
-- run: from_top
-- expect: 6

-- A function that was passed, and tables inside one.
local function bumped(f, p, n)
  return normalize(n - 0.1 * gradient(f, p))
end

function passed(p, n)
  return bumped(height, p, n), bumped(noise, p, n)
end

function tables(p)
  return gradient(function(q)
    local a = { q.x, q.y, q.z }
    local s = 0.0
    for i, v in ipairs(a) do s = s + v * i end
    a[2] = s * a[1]
    local r = { d = a[2], k = 2.0 }
    r.d = r.d + q.z * a[3]
    return r.d * r.k
  end, p)
end
