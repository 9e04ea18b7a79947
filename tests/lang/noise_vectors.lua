-- Vectors of noise begin with the noise itself.
function first(p, uv) return vnoise(p).x == noise(p), vvaluenoise(uv).x == valuenoise(uv), vcellnoise(p).x == cellnoise(p) end
-- run: first p=0.3,1.7,-2.9 uv=0.1,0.2
-- expect: true, true, true
function vectors(p, uv, time) return vnoise(p), vnoise(uv), vnoise(time), vnoise(vec4(p, time)) end
function of_values(p, uv, time) return vperlin(p), vperlin(uv), vperlin(time), vvaluenoise(p), vcellnoise(uv), vcellnoise(time) end
