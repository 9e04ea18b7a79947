-- print takes no part in what a shader gives: the same values and faults with it, at every width.
local function traced(x, i)
  print("step", i, x)
  return x * 0.5
end

function height(p, id)
  local s = p.x
  for i = 1, 4 do
    s = s + traced(p.y, i) * p.z
    if i == id then print("here", p, s > 1, id // 2) end
  end
  print()
  assert(id ~= 7, "seven")
  return s
end

-- run: height p=1,2,3 id=2
-- expect: 13
-- run: height p=1,2,3 id=7
-- expect: fault: assert
