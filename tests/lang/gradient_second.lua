-- A gradient inside the function of another: exact to the second order, where stock Lua takes differences of differences.
-- mild
-- near: 1e-5
local function height(q)
  return noise(q * 1.3) + 0.5 * sin(q.x * q.y) + length(q - vec3(0.1, 0.2, 0.3))
end

function steepness(p)
  return gradient(function(q) return length(gradient(height, q)) end, p)
end

function by_numbers(p)
  local a = gradient(function(x) return gradient(sin, x) end, p.x)
  local b = gradient(function(x) return gradient(function(y) return x * y ^ 3 + exp(0.3 * y) end, x) end, p.y)
  return a, b, gradient(function(x) return gradient(perlin, x) * x end, p.z + 0.37)
end

-- The outer variable stands in the inner function, captured: it moves as well.
function mixed(p)
  local h = gradient(function(q)
    local k = q.x * 0.5
    return gradient(function(r) return dot(r, q) ^ 2 * 0.1 + k * r.y * r.y end, q * 0.5).y
  end, p)
  return h
end

function vectors(p, n)
  local m = normalize(n + vec3(0, 0, 9))
  local a = gradient(function(q)
    return gradient(function(r)
      return distance(r, vec3(6, 7, 8)) + cross(r, q).x * 0.1 + reflect(r, m).y * r.z + refract(r * 0.1, m, 0.9).x
             + normalize(r + vec3(9, 0, 0)).y + faceforward(r, m, r).z * r.x
    end, q).x
  end, p)
  return a
end

function loops(p)
  return gradient(function(q)
    local s = 0.0
    for i = 1, 3 do
      s = s + gradient(function(x) return x ^ i + smoothstep(-9, 9, x) end, q.y) / i
      if q.x > 100 then break end
    end
    return s * q.z
  end, p)
end

function octaves(p)
  return gradient(function(q) return gradient(function(r) return fbm(r, 2) + perlin(r) * 0.5 end, q).z end, p + vec3(0.31, 0.17, 0.43))
end

function footprint(p, fw)
  return gradient(function(q) return fwidth(height, q, fw) end, p)
end


function matrices(p, n)
  local axis = n + vec3(0, 0, 7)
  return gradient(function(q)
    return gradient(function(r)
      local m = mat3(vec3(2, r.x, 0), vec3(r.y * 0.1, 3, r.z), vec3(q.x, 0, 60))
      local k = mat4(vec4(9, r.x, 0, 1), vec4(0, 8, r.y, 0), vec4(1, 0, 70, r.z), vec4(0, 1, 0, 80))
      return (m * r).y + determinant(m) * 0.001 + (inverse(m) * r).z + (transpose(m) * q).x + rotate(r, axis, r.x * 0.2).y
             + rotate(r.xy, r.z).x + determinant(k) * 1e-6 + (inverse(k) * vec4(r, 1)).x + (rotate(axis, r.y) * q).x
    end, q).x
  end, p)
end
