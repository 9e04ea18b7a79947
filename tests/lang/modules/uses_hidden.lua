require "modules.hides"
return { value = fract(2) }
