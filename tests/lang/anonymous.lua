-- Anonymous functions bound to locals.
local square = function(x) return x * x end
function use(time)
  local cube = function(x) return x * square(x) end
  return square(time), cube(time)
end
-- run: use time=3
-- expect: 9, 27
