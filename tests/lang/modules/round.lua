local other = require "modules.circle"
return { x = other.x }
