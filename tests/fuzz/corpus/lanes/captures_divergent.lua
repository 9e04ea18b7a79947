-- A call under a mask assigns captured variables of its own lanes only.
function divergent(p)
  local hits, last = 0, vec3(0)
  local function hit(v)
    if v.x > 2 then return false end
    hits = hits + 1
    last = v
    return true
  end
  for k = 1, 6 do
    if p.y * k > 2 then
      if not hit(p * k) then break end
    elseif p.z > 0 then
      hit(vec3(-k, p.z, 0))
    end
  end
  return hits, last
end
-- run: divergent p=0.25,1,1
-- expect: 6, 1.5, 6, 6
-- run: divergent p=1,1,1
-- expect: 2, -2, 1, 0
