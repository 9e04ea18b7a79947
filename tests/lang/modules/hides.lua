-- Takes a name of the library, which is the library's until then.
local old = fract
local before = fract(1.25)
function fract(x) return x + 100 end
return { old = old, before = before, after = fract(1) }
