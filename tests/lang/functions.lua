-- Local and global functions, specialised for the types of each call.
local function twice(x) return x + x end
local function compose(x) return twice(twice(x)) end
function shared(x) return x * 3 end

function of_types(p, time, frame) return twice(p), twice(time), twice(frame), compose(frame) end
-- run: of_types p=1,2,3 time=0.25 frame=21
-- expect: 2, 4, 6, 0.5, 42, 84

function of_global(time, uv) return shared(time), shared(uv) end
-- run: of_global time=2 uv=1,0.5
-- expect: 6, 3, 1.5

local function clamp_to(x, low, high)
  if x < low then return low end
  if x > high then return high end
  return x
end
function clamped(time) return clamp_to(time, -1.0, 1.0), clamp_to(time * 10, -1.0, 1.0) end
-- run: clamped time=0.25
-- expect: 0.25, 1

function later(time) return defined_below(time) + 1 end
function defined_below(x) return x * x end
-- run: later time=3
-- expect: 10
