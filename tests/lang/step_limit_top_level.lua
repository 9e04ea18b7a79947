-- The top level has the limit for itself, and each point anew.
-- steps: 10
local function id(x) return x end
local total = 0
for k = 1, 5 do total = total + id(k) end
function height(frame)
  for k = 1, frame do end
  return total
end
-- run: height frame=9
-- expect: 15
-- run: height frame=10
-- expect: fault: step-limit
