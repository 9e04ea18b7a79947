-- The workloads in LuaJIT, as one writes them for speed there: the loop over points in Lua, vectors spelled out as
-- numbers, arrays of C doubles; noise is C++'s (one lane, -O3 -march=native -ffast-math) by its FFI.
-- luajit luajit.lua LIBRARY WORKLOAD REPETITIONS SECONDS: prints "seconds S" (a point) for each repetition, and
-- "value ROW X..." for some rows.
local ffi = require "ffi"
ffi.cdef [[
float hand_noise(float x, float y, float z);
float hand_perlin(float x, float y, float z);
float hand_worley(float x, float y, float z);
typedef struct { float x, y, z; } hand_vec3;
void hand_noise_gradient(float x, float y, float z, hand_vec3* gradient);
]]
local library, workload, repetitions, least = ffi.load(arg[1]), arg[2], tonumber(arg[3]), tonumber(arg[4])
local floor, abs, sin, min, tobit, bxor, rshift = math.floor, math.abs, math.sin, math.min, bit.tobit, bit.bxor, bit.rshift
local noise, perlin, worley = library.hand_noise, library.hand_perlin, library.hand_worley

local WIDTH, HEIGHT = 1024, 64
local COUNT = WIDTH * HEIGHT
local px, py, pz = ffi.new("float[?]", COUNT), ffi.new("float[?]", COUNT), ffi.new("float[?]", COUNT)
for i = 0, COUNT - 1 do
  px[i] = 8 * (i % WIDTH + 0.5) / WIDTH
  py[i] = 8 * (floor(i / WIDTH) + 0.5) / HEIGHT
  pz[i] = 0.37
end
local out1, out2, out3 = ffi.new("float[?]", COUNT), ffi.new("float[?]", COUNT), ffi.new("float[?]", COUNT)

local function mix3(i, r0, g0, b0, r1, g1, b1, t)
  out1[i], out2[i], out3[i] = r0 + t * (r1 - r0), g0 + t * (g1 - g0), b0 + t * (b1 - b0)
end

local function marble(f)
  return function(i)
    local x, y, z = px[i], py[i], pz[i]
    local bend, weight, s = 0, 1, 1
    for _ = 1, 6 do
      bend = bend + weight * abs(f(x * s, y * s, z * s))
      s, weight = s * 2, weight * 0.5
    end
    mix3(i, 0.28, 0.30, 0.34, 0.90, 0.88, 0.84, 0.5 + 0.5 * sin(2 * x + 5 * bend))
  end
end

local function height(x, y, z)
  local sum, weight, s = 0, 1, 1
  for _ = 1, 4 do
    sum = sum + weight * noise(x * s, y * s, z * s)
    s, weight = s * 2, weight * 0.5
  end
  return sum
end

-- a * b modulo 2^32: the halves of b, so that products stay exact in doubles
local function mul32(a, b)
  a = a % 4294967296
  local low, high = b % 65536, floor(b / 65536)
  return tobit((a * low) % 4294967296 + ((a * high) % 65536) * 65536)
end
local function mix_bits(h)
  h = mul32(bxor(h, rshift(h, 16)), 0x7feb352d)
  h = mul32(bxor(h, rshift(h, 15)), 0x846ca68b)
  return bxor(h, rshift(h, 16))
end
local cast = ffi.new("union { float f; int32_t i; }")
local function float_bits(x)
  cast.f = x
  return cast.i
end

local gradient = ffi.new("hand_vec3[1]")
local points = {
  W1 = function(i) out1[i] = noise(px[i], py[i], pz[i]) end,
  W2 = marble(noise),
  W3a = function(i) out1[i] = perlin(px[i], py[i], pz[i]) end,
  W3b = marble(perlin),
  W4 = function(i)
    local x, y, z = px[i] * 0.5, py[i] * 0.5, pz[i] * 0.5
    local h, weight, s = 0, 1, 1
    for _ = 1, 8 do
      h = h + weight * perlin(x * s, y * s, z * s)
      s, weight = s * 2, weight * 0.5
    end
    if h < 0 then
      mix3(i, 0.03, 0.20, 0.30, 0.01, 0.04, 0.12, min(-2 * h, 1))
    elseif h < 0.4 then
      mix3(i, 0.09, 0.21, 0.05, 0.24, 0.19, 0.15, 2.5 * h)
    else
      mix3(i, 0.24, 0.19, 0.15, 0.90, 0.92, 0.95, min(4 * (h - 0.4), 1))
    end
  end,
  W5 = function(i)
    local cx, cy = px[i] * 0.3125 - 2, py[i] * 0.3125 - 1.25
    local x, y, n = 0, 0, 0
    while n < 256 and x * x + y * y <= 4 do
      x, y = x * x - y * y + cx, 2 * x * y + cy
      n = n + 1
    end
    out1[i] = n / 256
  end,
  W6 = function(i) out1[i] = worley(px[i], py[i], pz[i]) end,
  W7 = function(i)
    local x, y = px[i], py[i]
    local row = floor(4 * y)
    x = 2 * x + 0.5 * row
    local column = floor(x)
    if x - column < 0.04 or 4 * y - row < 0.08 then
      out1[i], out2[i], out3[i] = 0.62, 0.60, 0.56
      return
    end
    local h = mix_bits(tobit(mul32(mix_bits(float_bits(column)), 0x9e3779b1) + float_bits(row)))
    mix3(i, 0.42, 0.14, 0.09, 0.66, 0.29, 0.17, rshift(h, 8) / 16777216)
  end,
  W8fd = function(i)
    local x, y, z, e = px[i], py[i], pz[i], 1 / 1024
    out1[i] = (height(x + e, y, z) - height(x - e, y, z)) / (2 * e)
    out2[i] = (height(x, y + e, z) - height(x, y - e, z)) / (2 * e)
    out3[i] = (height(x, y, z + e) - height(x, y, z - e)) / (2 * e)
  end,
  W8ad = function(i)
    local x, y, z, s, weight = px[i], py[i], pz[i], 1, 1
    local gx, gy, gz = 0, 0, 0
    for _ = 1, 4 do
      library.hand_noise_gradient(x * s, y * s, z * s, gradient)
      local f = weight * s
      gx, gy, gz = gx + f * gradient[0].x, gy + f * gradient[0].y, gz + f * gradient[0].z
      s, weight = s * 2, weight * 0.5
    end
    out1[i], out2[i], out3[i] = gx, gy, gz
  end,
  height = function(i) out1[i] = height(px[i], py[i], pz[i]) end,
}

local point = assert(points[workload])
local function shade(first, last)
  for i = first, last do point(i) end
end

shade(0, COUNT - 1) -- compiles
for _ = 1, repetitions do
  local start, done = os.clock(), 0
  repeat
    shade(0, COUNT - 1)
    done = done + COUNT
  until os.clock() - start >= least
  print(("seconds %.9g"):format((os.clock() - start) / done))
end
for i = 0, COUNT - 1, 37 do
  print(("value %d %.9g %.9g %.9g"):format(i, out1[i], out2[i], out3[i]))
end
