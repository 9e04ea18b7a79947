-- Components by letter and number, and swizzles.
function components(p)
  local q = vec4(p, 9)
  return p.x, p.y, p.z, q.w, p.r, p.g, p.b, q.a, p[1], p[2], p[3], q[4]
end
-- run: components p=1,2,3
-- expect: 1, 2, 3, 9, 1, 2, 3, 9, 1, 2, 3, 9

function swizzles(p, uv) return p.zyx, p.xx, p.xyzx, uv.yx, uv.xyxy, p.bgr, p.rg, p.zyx.xy end
-- run: swizzles p=1,2,3 uv=4,5
-- expect: 3, 2, 1, 1, 1, 1, 2, 3, 1, 5, 4, 4, 5, 4, 5, 3, 2, 1, 1, 2, 3, 2

function of_expressions(p, n) return (p + n).y, (p * 2).zx, cross(p, n).x, vec2(p.x, 3).y end
-- run: of_expressions p=1,2,3 n=4,5,6
-- expect: 7, 6, 2, -3, 3
