local settings = require "modules.settings"
settings.count[1] = settings.count[1] + 1
runs = runs * 2
local inner = require "modules.scaled"
return { scale = settings.scale, seen = runs, inner = inner.scale }
