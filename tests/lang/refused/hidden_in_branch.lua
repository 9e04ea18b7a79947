local big = param("big", true)
if big then require "modules.hides" end
function height(p) return fract(p.x) end
-- error: 2:13 module-order
-- error: 3:27 function-not-known
