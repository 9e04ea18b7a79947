-- While the top level runs, functions may assign its variables and fill its tables.
local total, seen = 0, { 0.5, 0.5, 0.5 }
local function add(k)
  total = total + k
  seen[k % 3 + 1] = seen[k % 3 + 1] + k
end
for k = 1, 6 do add(k) end
local function fill(t, f)
  for i = 1, #t do t[i] = f(i) end
end
local SQUARES = { 0, 0, 0, 0 }
fill(SQUARES, function(i) return i * i end)
function height(p) return total + seen[1] + p.x * seen[3] + SQUARES[4] end
-- run: height p=0,0,0
-- expect: 46.5
