-- A module that hides a name of the library, for those who require it above.
local hides = require "modules.hides"
local after = fract(3)
local uses = require "modules.uses_hidden"
function values(time) return hides.before, hides.after, after, uses.value, fract(time), hides.old(1.25) == hides.before end
-- run: values time=4
-- expect: 0.25, 101, 103, 102, 104, true
