local detailed = true
if detailed then
  function height(p) return p.x end
end
function thing(p) return p.y end
function thing(p) return p.z end
-- error: 3:12 function-not-known
-- error: 6:10 function-not-known
