-- one table stands in one slot only
function height(p)
  local a = { 1.0 }
  local t = { a, a }
  t[1][1] = p.x
  return t[2][1]
end
-- error: 4:15 table-twice
-- error: 4:18 table-twice
