local a = require "modules.circle"
function height(p) return a.x end
-- error: 1:15 module-cycle
