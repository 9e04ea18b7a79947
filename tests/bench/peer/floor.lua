-- The peer's checkerboard: squares of half a unit.
function color(p) return vec3(mix(0.2, 0.4, checker(vec2(p.x * 2, p.z * 2), 0))) end
