-- Noise: the same in the interpreter, on one lane and on many.
function simplex(p, uv, time) return noise(p), noise(uv), noise(time), noise(p * 1000), noise(p + 1e6) end
function perlins(p, uv, time) return perlin(p), perlin(uv), perlin(time), perlin(p * 1000), perlin(-p) end
-- run: perlins p=1,2,3 uv=4,5 time=6
-- expect: 0, 0, 0, 0, 0
function at_integers(frame) return noise(frame), perlin(frame) end
-- run: at_integers frame=7
-- expect: 0, 0
