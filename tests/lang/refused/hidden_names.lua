local in_loop = 0.0
for k = 1, 2 do
  in_loop = in_loop + floor
  floor = 3
end
local early = sign(-2)
if early < 0 then ceil = 2 end
function height(p) return ceil + p.x end
local kept = tostring(1)
function tostring(x) return x end
function fract(p) return fract(p) end
color = noise
local function own(x) return x end
tan = own
-- error: 3:23 unassigned-variable
-- error: 8:27 unassigned-variable
-- error: 9:14 string-building
-- error: 11:26 recursion
-- error: 12:1 function-not-known
-- error: 14:1 function-not-known
