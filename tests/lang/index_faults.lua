-- An index outside of 1..#a ends the point.
local T <const> = { 1.0, 2.0, 4.0 }
function read(p) return T[math.floor(p.x)] end
-- run: read p=3,0,0
-- expect: 4
-- run: read p=0,0,0
-- expect: fault: index
-- run: read p=4,0,0
-- expect: fault: index

function write(p)
  local t = { p.x, p.y }
  t[math.floor(p.z)] = 5
  return t[1] + t[2]
end
-- run: write p=1,1,3
-- expect: fault: index

function nested(p)
  local t = { { 1, 2 }, { 3, 4 } }
  return t[math.floor(p.x)][math.floor(p.y)]
end
-- run: nested p=2,1,0
-- expect: 3
-- run: nested p=1,3,0
-- expect: fault: index

function by_number(p)
  return T[p.x]
end
-- run: by_number p=2,0,0
-- expect: 2
-- run: by_number p=1.5,0,0
-- expect: fault: integer-range
-- run: by_number p=7,0,0
-- expect: fault: index

function in_branch(p)
  local s = 0.0
  if p.x > 1 then s = T[math.floor(p.x)] end
  return s
end
