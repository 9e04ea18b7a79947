local OPEN = { { 1.5, 2.5, 3.5, 4.5, unknown(1.5) } }
local UNEQUAL = { { 1, 2 }, { 3, 4, 5, 6, 7, 8, 9 } }
function height(p) return p.x + OPEN[1][1] + UNEQUAL[1][1] end
-- error: 1:38 unknown-name
-- error: 2:29 table-shapes
