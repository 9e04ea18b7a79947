-- Sums of octaves, a fraction of the last one, and footprints that hide the fine ones.
function sums(p, uv, time) return ridged(p), hybrid(p), warp(p), ridged(uv, 3), hybrid(time, 4, 2.1, 0.4), warp(uv, 2.5) end
function seen(p, fw) return fbm(p, 5, 2, 0.5, fw), turbulence(p, 5, 2, 0.5, fw), ridged(p, 5, 2, 0.5, fw), hybrid(p, 5, 2, 0.5, fw, 0.8), warp(p, 5, 2, 0.5, fw, 0.4) end
-- An eighth of a unit hides all but two octaves; half of one hides all.
function hidden(p) return fbm(p, 6, 2, 0.5, 0.125) == fbm(p, 2), fbm(p, 6, 2, 0.5, 0.5) end
-- run: hidden p=0.3,1.7,-2.9
-- expect: true, 0
function fractions(p, uv, frame) return fbm(p, p.x), turbulence(uv, frame / 4), ridged(p, 2.5), hybrid(uv, uv.x, 2, 0.5, uv.y) end
function of_four(p, time) return fbm(vec4(p, time), 3), turbulence(vec4(p, time), 2) end
