local other = require "modules.round"
return { x = other.x }
