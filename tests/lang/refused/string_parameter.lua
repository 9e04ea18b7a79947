-- a string parameter is compared with constants alone
local mode = param("mode", "warm")
local other = param("other", "warm")
local which = mode
which = other
function height(p)
  if mode == other then return 1 end
  if mode < "b" then return 3 end
  if mode == 1 then return 4 end
  return #mode
end
-- error: 5:9 type-conflict
-- error: 7:6 depends-on-parameter
-- error: 8:6 operand-type
-- error: 8:13 operand-type
-- error: 9:6 operands-do-not-fit
-- error: 10:11 depends-on-parameter
