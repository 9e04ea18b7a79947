local m = require "modules.same_place"
function height(p) return nowhere end
-- error: 2:27 unknown-name
-- error: 2:27 unknown-name
