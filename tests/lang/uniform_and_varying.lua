-- Values that all lanes share beside values of each lane, in loops that mix them.
local count = param("count", 4)
local function weight(k) return 1 / (k + 1) end
function mixed(p)
  local shared, own = 0.0, 0.0
  for k = 1, count do
    shared = shared + weight(k)
    if p.x > shared then own = own + shared end
    if shared > 1 and p.y > 2 then shared = 0.0 end
  end
  return shared, own
end
function bound_of_lane(p)
  local k, s = 0, 0
  while k < count do
    local m = 0
    while m < p.x and m < 3 do
      s = s + count
      m = m + 1
    end
    k = k + 1
  end
  return s
end
-- run: bound_of_lane p=2,0,0
-- expect: 32
-- run: bound_of_lane p=2,0,0 -D count=1
-- expect: 2
