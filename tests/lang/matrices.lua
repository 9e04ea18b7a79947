-- Matrices are values: columns of vectors, products with vectors and matrices, the rest by component.
local SWAP <const> = mat3(0, 1, 0, 1, 0, 0, 0, 0, 1)

function column(p, n) return mat3(p, n, p + n)[2], mat3(p, n, p)[3].y, mat3(1, 2, 3, vec3(4, 5, 6), n)[1] end
-- run: column p=1,2,3 n=4,5,6
-- expect: 4, 5, 6, 2, 1, 2, 3

function times_vector(p) return SWAP * p, mat3(p, 2 * p, 3 * p) * p, mat4(2) * vec4(p, 1) end
-- run: times_vector p=1,2,3
-- expect: 2, 1, 3, 14, 28, 42, 2, 4, 6, 2

function times_matrix(p)
  local m = mat3(p, p.yzx, p.zxy)
  local square, turned = m * m, m * SWAP
  return square[1], square[3], turned[1], turned[2]
end
-- run: times_matrix p=1,2,3
-- expect: 14, 11, 11, 11, 11, 14, 2, 3, 1, 1, 2, 3

function by_component(p, time)
  local m = mat3(p, p, p)
  return (m + SWAP)[1], (m - SWAP)[1], (m * time)[2], (time * m)[3], (m / 2)[1], (-m)[1], (m * 2)[1]
end
-- run: by_component p=1,2,4 time=3
-- expect: 1, 3, 4, 1, 1, 4, 3, 6, 12, 3, 6, 12, 0.5, 1, 2, -1, -2, -4, 2, 4, 8

function equality(p) return mat3(p, p, p) == mat3(p, p, p), mat3(p, p, p) ~= SWAP, mat4(1) == mat4(mat3(1)) end
-- run: equality p=1,2,3
-- expect: true, true, true

function functions(p)
  local m = mat3(2, 0, 0, 0, 4, 0, 1, 0, 1)
  local back = inverse(m) * (m * p)
  return transpose(m)[1], determinant(m), m:determinant(), m:inverse()[1], back, transpose(transpose(m)) == m
end
-- run: functions p=1,2,3
-- expect: 2, 0, 1, 8, 8, 0.5, 0, 0, 1, 2, 3, true

function of_four(p, time)
  local m = mat4(vec4(1, 2, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 2, 0), vec4(p, 1))
  return m * vec4(0, 0, 0, 1), determinant(m), inverse(m)[4], mat3(m)[1], (m * inverse(m) * vec4(p, time))
end
-- run: of_four p=1,2,4 time=3
-- expect: 1, 2, 4, 1, 2, -1, 0, -2, 1, 1, 2, 0, 1, 2, 4, 3

function any_matrix(p, n, time)
  local m = mat4(vec4(p, time), vec4(n, 2), vec4(time, p), vec4(n.zx, p.y, 1))
  local k = mat3(p, n, p:cross(n) + 0.5)
  return determinant(m), inverse(m)[1], inverse(m)[2], inverse(m)[3], inverse(m)[4], determinant(k), k:inverse() * p
end

function rotated(uv, p, n, time)
  return uv:rotate(time), rotate(p, n, time), rotate(n, time) * p, rotate(vec2(1, 0), math.pi / 2) == vec2(0, 1)
end

local function twice(m) return m * m end
function in_variables(p, n, time)
  local m = mat3(1)
  for i = 1, 3 do
    if p.x > 0 then m = m * rotate(n, time) else m = m + SWAP end
  end
  return m * p, twice(m) * n, (p.y > 0 and m or SWAP)[1]
end
