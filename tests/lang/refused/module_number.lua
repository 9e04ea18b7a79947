-- The error stands in the module's file.
local a = require "modules.number"
function height(p) return p.x end
-- error: 1:8 module-result
