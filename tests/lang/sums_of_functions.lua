-- Sums of a noise that is given: the library's, closures that capture, functions of the shader.
local scale = param("scale", 2.0)
local offset = vec3(0.5, 1.5, -0.25)
local function moved(q) return perlin(q * scale + offset) end
-- Whole numbers count as numbers; what is beyond the first result is not summed.
local function steps(q) return math.floor(clamp(q.x, -9, 9)), 7 end

function noises(p, uv, time)
  return fbm(worley, p, 4), turbulence(perlin, p, 3, 2.1, 0.4), ridged(valuenoise, uv, 3), hybrid(gabor, uv, 2, 2, 0.5, 0, 0.6),
    warp(worley, p, 2), warp(perlin, time, 3), warp(valuenoise, vec4(p, time), 2), warp(cellnoise, uv, 2)
end
function closures(p, uv, fw)
  local function ringed(q) return sin(length(q) * fw) end
  return fbm(moved, p, 3), turbulence(function(q) return pworley(q, vec2(3, 4)) end, uv, 3), fbm(steps, p, 2), ridged(ringed, p, 2)
end
-- Inside each other, and beside a name that the shader has taken.
function mix(a) return a end
function min(a) return a end
function nested(p)
  return mix(min(fbm(function(q) return fbm(worley, q, 2) * 0.5 end, p, 2)))
end
function fractions(p, uv, frame) return fbm(perlin, p, p.x), turbulence(worley, uv, frame / 4), hybrid(noise, uv, uv.x, 2, 0.5, uv.y) end
function seen(p, fw)
  return fbm(worley, p, 5, 2, 0.5, fw), turbulence(perlin, p, 4, 2, 0.5, fw), ridged(worley, p, 4, 2, 0.5, fw),
    hybrid(perlin, p, 4, 2, 0.5, fw, 0.8), warp(worley, p, 4, 2, 0.5, fw, 0.4), fbm(moved, p, 4, 2, 0.5, fw, 0.25)
end
-- What is too fine leaves the mean: of worley's F1, or as given.
function hidden(p) return fbm(worley, p, 1, 2, 0.5, 0.5), fbm(moved, p, 2, 2, 0.5, 0.5, 0.25), turbulence(cellnoise, p, 1, 2, 0.5, 3) end
-- run: hidden p=0.3,1.7,-2.9
-- expect: 0.52029999999999998, 0.375, 0.5

-- Given `noise`, they are the sums without a function, bit for bit.
function same(p, uv, fw, time)
  return fbm(noise, p, 4.5, 2.1, 0.4, fw) == fbm(p, 4.5, 2.1, 0.4, fw), turbulence(noise, uv, 5, 2, 0.5, fw) == turbulence(uv, 5, 2, 0.5, fw),
    ridged(noise, p, 4, 2, 0.5, fw) == ridged(p, 4, 2, 0.5, fw), hybrid(noise, p, 4, 2, 0.5, fw, 0.8) == hybrid(p, 4, 2, 0.5, fw, 0.8),
    warp(noise, p, 3, 2, 0.5, fw, 0.7) == warp(p, 3, 2, 0.5, fw, 0.7), warp(noise, time, 3) == warp(time, 3),
    warp(noise, vec4(p, time), 3) == warp(vec4(p, time), 3), warp(noise, uv, 3) == warp(uv, 3), fbm(noise, p) == fbm(p)
end
-- run: same p=0.3,1.7,-2.9 uv=0.2,0.7 fw=0.05 time=1.5
-- expect: true, true, true, true, true, true, true, true, true
-- run: same p=-12.25,0.7,3.1 uv=5.2,-0.7 fw=0 time=-0.5
-- expect: true, true, true, true, true, true, true, true, true
