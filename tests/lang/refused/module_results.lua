local a = require "modules.nothing"
function height(p) return p.x end
-- error: 1:11 module-result
