local function f(a, b) return a + b end
function height(p)
  return f(p.x) + smoothstep(0, 1)
end
-- error: 3:10 missing-argument
-- error: 3:19 missing-argument
