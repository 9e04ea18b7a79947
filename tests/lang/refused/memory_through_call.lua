local last = 0.0
local function note(x) last = x end
function height(p)
  note(p.x)
  return last
end
-- error: 2:24 shader-has-no-memory
