-- Tables of constants that nothing changes are stored as data, wherever they are written.
local T = { 0.5, 1, -3, 1/3 }
local V = { {c = rgb(1,0.5,0), k = 2, ok = true}, {c = vec3(3), k = 7, ok = false} }
function height(p, id)
  local L = { 1, 2, 3 }
  local r = V[id % 2 + 1]
  return T[id % #T + 1] + L[id % 3 + 1] + r.c.y + (r.ok and r.k or 0) + V[1].k
end
-- run: height p=1,2,3 id=2
-- expect: 4.5

local CHANGED = { 1.0, 2.0 }
CHANGED[2] = 5
local NEGATIVE <const> = { { -1, 2^3 }, { 0x10, math.huge } }
function others(p, id)
  return CHANGED[id % 2 + 1] * NEGATIVE[id % 2 + 1][1] + p.x, NEGATIVE[1][id % 2 + 1], NEGATIVE[2][2]
end
-- run: others p=1,0,0 id=1
-- expect: 81, 8, inf
