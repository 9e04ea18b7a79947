local KEYED = { [1] = 2 }
local EMPTY = {}
local MIXED = { 1, x = 2 }
local TWICE = { x = 1, x = 2 }
local FUNCTIONS = { sin, cos }
local SHAPES = { { 1, 2 }, { 3 } }
local FROZEN = { 1, 2, 3 }
function height(p)
  local a, b = { 1, 2 }, { 3, 4 }
  local c = p.x > 0 and a or b
  local i, j = math.floor(p.x), math.floor(p.y)
  a[i], a[j] = 1, 2
  FROZEN[1] = p.x
  a = { 5, 6 }
  local r = { inner = { 1 }, f = sin }
  r.inner = { 2 }
  r.f = cos
  return r.outer + a.x + r[1] + a[true] + c[1]
end
-- error: 1:17 keyed-field
-- error: 2:15 empty-table
-- error: 3:20 mixed-table
-- error: 4:24 field-twice
-- error: 5:21 array-element
-- error: 5:26 array-element
-- error: 6:28 table-shapes
-- error: 10:13 table-not-known
-- error: 12:9 order-of-evaluation
-- error: 13:3 shader-has-no-memory
-- error: 14:3 table-not-known
-- error: 16:3 table-slot
-- error: 17:3 table-slot
-- error: 18:12 unknown-field
-- error: 18:22 unknown-field
-- error: 18:28 record-index
-- error: 18:35 index-type
