local c = param("c", true)
require "modules.settings"
runs = 3
if c then require "modules.counts" end
function height(p) return runs * p.x end
-- error: 4:11 module-order
