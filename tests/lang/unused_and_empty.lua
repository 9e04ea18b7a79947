-- Statements without effect, empty blocks, unused functions and results.
;;; local unused = 1
local function never_called(x) return x.y end
do end
function height(p)
  local a, b, c = 1, 2, 3
  ;
  do local d = p.x end
  if p.x > 0 then end
  for k = 1, 0 do end
  while false do end
  repeat until true
  abs(p.x)
  local _ = noise(p)
  return p.y;
end
-- run: height p=1,2,3
-- expect: 2
