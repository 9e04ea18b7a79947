-- One function, many lists of argument types; the same syntax means another thing in each.
local function scale(x, k) return x * k end
local function biggest(a, b) if a > b then return a end return b end
function mixes(p, uv, time, frame) return scale(p, time), scale(time, p), scale(uv, frame), scale(frame, 2), scale(frame, time) end
-- run: mixes p=1,2,3 uv=4,5 time=0.5 frame=3
-- expect: 0.5, 1, 1.5, 0.5, 1, 1.5, 12, 15, 6, 1.5
function of_integers(frame, id, time) return biggest(frame, id), biggest(time, 0.5) end
-- run: of_integers frame=3 id=4 time=1
-- expect: 4, 1
function kinds(frame, time) return scale(frame, frame) // 2, scale(time, 1.0) // 2 end
-- run: kinds frame=5 time=5
-- expect: 12, 2
