function height(p)
  p.x;
  1 + 2
  f() = 3
  return p.x
end
local a = = 3
local function ok(x) return x end
-- error: 2:6 not-a-statement
-- error: 3:3 syntax-error
-- error: 4:7 cannot-assign
-- error: 7:11 syntax-error
