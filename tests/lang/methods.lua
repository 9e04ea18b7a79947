-- Method sugar on vectors means the library's function, shadowed or not.
function methods(p, n) return p:length(), p:dot(n), p:cross(n), p:normalize():length() end
-- run: methods p=3,4,0 n=0,0,2
-- expect: 5, 0, 8, -6, 0, 1

function shadowed(p)
  local length = 3.0
  return p:length() + length
end
-- run: shadowed p=3,4,0
-- expect: 8

function chained(p) return (p * 2):distance(p), p:mix(vec3(0), 0.5), p:clamp(0, 1) end
-- run: chained p=2,0,0
-- expect: 2, 1, 0, 0, 1, 0, 0
