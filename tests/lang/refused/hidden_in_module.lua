local early = fract(1.25)
local function call() return fract(0.5) end
local called = call()
local reads = require "modules.reads_hidden"
local hides = require "modules.hides"
function height(p) return early + called + reads.value + hides.after + fract(p.x) end
-- error: 1:15 function-not-known
-- error: 2:30 function-not-known
-- error: 1:18 function-not-known
