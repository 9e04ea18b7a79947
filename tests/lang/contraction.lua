-- a*b + c: two roundings in double, never one.
function products(p, n)
  return p.x * n.x + p.y, p.x * n.x - p.y, p.z - p.x * n.y, p * n + p, -(p.x * n.x) + p.y, (p.x * p.x - n.x * n.x)
end
function horner(time) return ((time * 0.3 + 0.7) * time - 0.1) * time + 0.9 end
function folded() return 1e16 * 3 + 1, 0.1 * 10 - 1, 0.1 * 3 - 0.3 end
-- run: folded
-- expect: 30000000000000000, 0, 5.5511151231257827e-17
