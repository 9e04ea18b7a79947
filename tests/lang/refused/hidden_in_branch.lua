local big = param("big", true)
if big then require "modules.hides" end
function height(p) return fract(p.x) end
-- error: 3:27 function-not-known
