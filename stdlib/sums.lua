-- Sums of a noise that is given as a function: what fractal.h sums of simplex noise, by the same formulas. Compiled code
-- and stock Lua run this one text: sema specialises it for the function and the point as it does a shader's own
-- functions, the module `moonshade` loads it into an environment of its own. Its names are the library's and its own,
-- whatever a shader calls so. Each pass of its loops is a step, its calls are none.
--
-- Every product that is added to once is one fused operation under f32 (compiler/ir/fuse.cpp), just where fractal.h has
-- `madd`: given `noise`, the sums have the bits of those without a function.

-- What a pixel of this width sees of an octave; footprint is its width in the octave's units.
function seen(width, footprint)
  if width > 0 then
    local t = saturate(2 - 4 * abs(footprint))
    return t * t * (3 - 2 * t)
  end
  return 1.0
end

-- The shape of f(p), as far as it is seen, and its mean for the rest.
function see(f, shape, p, width, visible, mean)
  local n = mean
  if visible > 0 then
    n = shape((f(p)))
    if width > 0 then n = mix(mean, n, visible) end
  end
  return n
end

function wanted(octaves) return octaves > 0 and min(octaves, 32) or 0.0 end

function same(n) return n end
function ridge(n)
  local height = 1 - abs(n)
  return height * height
end

function octave_sum(f, shape, p, octaves, lacunarity, gain, width, mean)
  local count, i, sum, amplitude, footprint = wanted(octaves), 0.0, 0.0, 1.0, width
  while i < count do
    local n = see(f, shape, p, width, seen(width, footprint), mean)
    sum = n * (amplitude * min(1, count - i)) + sum
    p, amplitude, footprint, i = p * lacunarity, amplitude * gain, footprint * lacunarity, i + 1
  end
  return sum
end

function fbm(f, p, octaves, lacunarity, gain, width, mean)
  return octave_sum(f, same, p, octaves, lacunarity, gain, width, mean)
end

function turbulence(f, p, octaves, lacunarity, gain, width, mean)
  return octave_sum(f, abs, p, octaves, lacunarity, gain, width, mean)
end

function ridged(f, p, octaves, lacunarity, gain, width, mean)
  local count, i, sum, before, amplitude, footprint = wanted(octaves), 0.0, 0.0, 1.0, 1.0, width
  while i < count do
    local signal = see(f, ridge, p, width, seen(width, footprint), mean) * before
    sum = signal * (amplitude * min(1, count - i)) + sum
    before = saturate(2 * signal)
    p, amplitude, footprint, i = p * lacunarity, amplitude * gain, footprint * lacunarity, i + 1
  end
  return sum
end

function hybrid(f, p, octaves, lacunarity, gain, width, offset, mean)
  local count, i, sum, before, amplitude, footprint = wanted(octaves), 0.0, 0.0, 1.0, 1.0, width
  while i < count do
    local n = see(f, same, p, width, seen(width, footprint), mean)
    local signal = (n + offset) * (amplitude * min(1, count - i)) * min(before, 1)
    sum = sum + signal
    before = signal
    p, amplitude, footprint, i = p * lacunarity, amplitude * gain, footprint * lacunarity, i + 1
  end
  return sum
end

-- Three sums of simplex noise: the way that warping moves a point.
function way(p, octaves, lacunarity, gain, width)
  local count, i, sum, amplitude, footprint = wanted(octaves), 0.0, vec3(0), 1.0, width
  while i < count do
    local visible = seen(width, footprint)
    if visible > 0 then sum = vnoise(p) * (amplitude * min(1, count - i) * visible) + sum end
    p, amplitude, footprint, i = p * lacunarity, amplitude * gain, footprint * lacunarity, i + 1
  end
  return sum
end

-- By the dimensions of p; of four the first three are moved.
function warp1(f, p, octaves, lacunarity, gain, width, strength, mean)
  local moved = way(p, octaves, lacunarity, gain, width).x * strength + p
  return fbm(f, moved, octaves, lacunarity, gain, width, mean)
end

function warp2(f, p, octaves, lacunarity, gain, width, strength, mean)
  local moved = way(p, octaves, lacunarity, gain, width).xy * strength + p
  return fbm(f, moved, octaves, lacunarity, gain, width, mean)
end

function warp3(f, p, octaves, lacunarity, gain, width, strength, mean)
  local moved = way(p, octaves, lacunarity, gain, width) * strength + p
  return fbm(f, moved, octaves, lacunarity, gain, width, mean)
end

function warp4(f, p, octaves, lacunarity, gain, width, strength, mean)
  local moved = way(p, octaves, lacunarity, gain, width) * strength + p.xyz
  return fbm(f, vec4(moved, p.w), octaves, lacunarity, gain, width, mean)
end
