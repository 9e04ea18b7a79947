-- Each family of noise in every dimension it has: the same in the interpreter, on one lane and on many.
function four(p, time) return noise(vec4(p, time)), perlin(vec4(p, time)) end
function values(p, uv, time) return valuenoise(time), valuenoise(uv), valuenoise(p), valuenoise(vec4(p, time)) end
function cells(p, uv, time) return cellnoise(time), cellnoise(uv), cellnoise(p), cellnoise(vec4(p, time)) end
-- run: cells p=1.5,2,-3 uv=0.25,7 time=3
-- expect: 0.82045787572860718, 0.27126204967498779, 0.92528432607650757, 0.43465113639831543
function worleys(p, uv, time)
  local f1, f2, id = worley(p)
  local a, b = worley(uv, 1)
  local c = worley(time, math.huge)
  return f1, f2, id, f2 - f1, a, b, c, (worley(vec4(p, time)))
end
function gabors(p, uv, time) return gabor(time), gabor(uv, 3), gabor(p), gabor(p, vec3(1, 2, 0)), gabor(uv, uv) end
-- A method means the function; a number of the metric may differ by point.
function methods(p, uv) return p:noise(), p:valuenoise(), uv:cellnoise(), uv:worley(p.x) end
function curls(p, uv, time) return curl(uv), curl(p), curl(vec4(p, time)) end
