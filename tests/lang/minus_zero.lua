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
