-- Stock Lua compiles `x - 0`, where it knows that the integer is 0, as `x + 0`: -0.0 becomes 0.0 (1/x tells them apart).
local Z <const> = 0
local V = 0
function subtracted(time)
  return 1 / (time - 0), 1 / (time - (1 - 1)), 1 / (time - Z), 1 / (time - V), 1 / (time - 0.0), 1 / (time + 0)
end
-- run: subtracted time=-0.0
-- expect: inf, inf, inf, -inf, -inf, inf

function vectors(p) return 1 / (p - 0).x end
-- run: vectors p=-0.0,0,0
-- expect: -inf

local Y <const> = Z * 3 + 7 // 9
function folded(time)
  local X <const> = 3 & 4
  return 1 / (time - 1 // 2), 1 / (time - 7 % 7), 1 / (time - (0 << 3)), 1 / (time - (5 >> 3)), 1 / (time - -(0)), 1 / (time - ~-1),
    1 / (time - Y), 1 / (time - X), 1 / (time - (-7 // 7 + 1)), 1 / (time - -6 % 3), 1 / (time - (1 << 64)), 1 / (time - #"")
end
-- run: folded time=-0.0
-- expect: inf, inf, inf, inf, inf, inf, inf, inf, inf, inf, inf, -inf
