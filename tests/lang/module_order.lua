-- A module runs where it is required first, and sees what files did until then.
local settings = require "modules.settings"
settings.scale = 5
runs = runs + 2
local counts = require("modules.counts")
settings.scale = 7
local scaled = require "modules.scaled"
runs = runs + 1
function height(time)
  return counts.scale + 10 * counts.inner + scaled.scale
end
-- run: height time=0
-- expect: 5505

function state(time) return runs, settings.count[1], settings.scale, counts.seen end
-- run: state time=0
-- expect: 7, 10, 7, 6

-- One that nobody's changes reach may be required anywhere.
local function late() return require("modules.plain").gain end
function anywhere(time) return late() + require("modules.plain").gain end
