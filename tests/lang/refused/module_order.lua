local settings = require "modules.settings"
settings.scale = 3
local function late() return require("modules.scaled").scale end
settings.scale = 4
function height(p) return late() * settings.scale end
-- error: 3:30 module-order
