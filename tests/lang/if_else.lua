-- Branches that diverge, nest, and assign.
function nested(p)
  local x = 0.0
  if p.x > 0 then
    if p.y > 0 then x = 1.0 elseif p.y < -1 then x = 2.0 else x = 3.0 end
    x = x + p.z
  elseif p.x < -2 then
    x = p.x
  end
  return x
end
-- run: nested p=1,1,10
-- expect: 11
-- run: nested p=1,-0.5,10
-- expect: 13
-- run: nested p=-3,0,0
-- expect: -3
-- run: nested p=-1,0,0
-- expect: 0

function early(p)
  if p.x > 1 then return 1 end
  if p.y > 1 then return 2 end
  if p.x + p.y > 1 then return 3 else return p.z end
end
-- run: early p=0.7,0.7,5
-- expect: 3
-- run: early p=0,0,5
-- expect: 5

function empty_branches(p)
  if p.x > 0 then elseif p.y > 0 then else return 1.0 end
  return 2.0
end
-- run: empty_branches p=-1,-1,0
-- expect: 1
