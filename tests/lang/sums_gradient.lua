-- Derivatives go through sums of functions.
-- mild
-- near: 1e-5
local function own(q) return sin(q.x) * cos(q.y + q.z) end
function slopes(p, uv) return gradient(function(q) return fbm(own, q, 3) end, p), gradient(function(q) return turbulence(noise, q * 0.93 + vec2(0.137, 0.211), 2) end, uv) end
function exact(p)
  local a = gradient(function(q) return fbm(noise, q, 3) end, p)
  local b = gradient(function(q) return fbm(q, 3) end, p)
  return distance(a, b) < 1e-5 * (1 + length(b))
end
-- run: exact p=0.3,1.7,-2.9
-- expect: true
