-- The library's functions of vectors.
function products(p, n) return dot(p, n), cross(p, n), length(p), distance(p, n), dot(p.xy, n.xy), length(p.xy) end
-- run: products p=1,2,3 n=4,5,6
-- expect: 32, -3, 6, -3, 3.7416573867739413, 5.196152422706632, 14, 2.2360679774997898

function directions(p, n, i) return normalize(p), reflect(i, n), faceforward(n, i, n), refract(i, n, 0.75) end
-- run: directions p=0,3,4 n=0,0,1 i=0,0,-1
-- expect: 0, 0.60000000000000009, 0.80000000000000004, 0, 0, 1, 0, 0, 1, 0, 0, -1

function zero() return normalize(vec3(0)), length(vec2(0)) end
-- run: zero
-- expect: 0, 0, 0, 0
