-- Each octave is a step, and each call of a function of the shader; the sum's call is none. 1 + 3 octaves + 3 calls.
-- steps: 7
local function own(q) return q.x end
function within(p) return fbm(own, p, 3) end
-- run: within p=1,2,3
-- expect: 3
function beyond(p) return fbm(own, p, 4) end
-- run: beyond p=1,2,3
-- expect: fault: step-limit
