-- Functions of numbers take vectors, by component; a number beside a vector counts for each.
function by_component(p, n) return abs(p), floor(p), min(p, n), mix(p, n, 0.5), mix(p, n, n), clamp(p, 0, 1), max(p, 0.5) end
-- run: by_component p=-1.5,0.25,2 n=0,1,0.5
-- expect: 1.5, 0.25, 2, -2, 0, 2, -1.5, 0.25, 0.5, -0.75, 0.625, 1.25, -1.5, 1, 1.25, 0, 0.25, 1, 0.5, 0.5, 2

function of_pairs(uv) return sin(uv), smoothstep(0, 1, uv), step(0.5, uv), pow(uv, 2), fract(uv * 3) end
function of_fours(p, uv) return exp(vec4(uv, uv)), sqrt(vec4(p, 1)), mod(vec4(p, 2), 0.75) end
