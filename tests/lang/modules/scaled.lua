local settings = require "modules.settings"
settings.count[1] = settings.count[1] * 10
return { scale = settings.scale * 100 }
