-- Derivatives through matrices: products, functions of matrices, rotations.
-- mild
-- near: 1e-6
local function turned(q) return (rotate(q, q.x) * vec3(1, 2, 3)).y end
local function quotient(q)
  local m = mat3(q + vec3(4, 0, 0), q.yzx + vec3(0, 4, 0), vec3(1, q.x, 6))
  return (inverse(m) * q).x + determinant(m) * 0.1 + transpose(m)[2].z + (m * m)[1].y * 0.2
end
local function of_four(q)
  local m = mat4(vec4(q, 9), vec4(1, 7, 2, q.y), vec4(0, q.x, 8, 1), vec4(2, 0, q.z, 6))
  return determinant(m) * 0.01 + (inverse(m) * vec4(q, 1)).y + (m * vec4(q.zyx, 2)).w + (m + m * 2)[3].y
end
local function spun(q) return q.xy:rotate(q.z).x + rotate(q, vec3(1, q.y, 0.5), 2).z end

function gradients(p)
  local q = saturate(p * 0.1 + 0.5) * 0.5 + 0.2
  return gradient(turned, q), gradient(quotient, q), gradient(of_four, q), gradient(spun, q)
end
