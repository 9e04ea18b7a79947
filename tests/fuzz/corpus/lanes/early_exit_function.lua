-- Functions that return early in some lanes, called in expressions and conditions.
local function classify(x)
  if x ~= x then return 0 end
  for k = 1, 5 do
    if x < k then
      if k == 2 then return 20 end
      return k
    end
  end
  return 99
end
function conditions(p)
  local r = 0
  if classify(p.x) > 2 and classify(p.y) < 50 then r = 1 end
  while r < 40 and classify(p.z + r) < 99 do r = r + 3 end
  return r + classify(p.x) * 100
end
-- run: conditions p=3.5,0,0
-- expect: 407
