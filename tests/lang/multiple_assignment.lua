-- All right sides are evaluated before any assignment.
function swap(p)
  local a, b, c = p.x, p.y, p.z
  a, b, c = c, a, b
  a, b = b, a
  return a, b, c
end
-- run: swap p=1,2,3
-- expect: 1, 3, 2

function rotate_in_loop(frame)
  local a, b = 0, 1
  for k = 1, frame & 31 do a, b = b, a + b end
  return a
end
-- run: rotate_in_loop frame=20
-- expect: 6765

function swizzled(p)
  p = p.zxy
  local q = p
  p, q = q.yzx, p * 2
  return p, q
end
-- run: swizzled p=1,2,3
-- expect: 1, 2, 3, 6, 2, 4
