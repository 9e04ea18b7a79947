local a = require "modules.absent"
local b = require "../modules/number"
local name = "modules.number"
local c = require(name)
function height(p) return a.x + b.x + c.x end
-- error: 1:19 module-not-found
-- error: 2:19 module-name
-- error: 4:19 module-name
