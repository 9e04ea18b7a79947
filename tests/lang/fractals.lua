-- Sums of noise, with octaves that depend on the point.
function turbulences(p) return turbulence(p), turbulence(p, 3), turbulence(p, 3, 2.1), turbulence(p, 3, 2.1, 0.45) end
function sums(p, uv, time) return fbm(p), fbm(uv, 4), fbm(time, 5, 1.9, 0.6) end
function octaves_of_point(p, frame) return turbulence(p, frame), fbm(p, p.x) end
