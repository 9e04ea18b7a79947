-- Library names that the file gives another meaning, at the top level.
local noise = 3.5
local sin = function(x) return x * 2 end
function max(a, b) return a - b end
function used(p, time) return noise + sin(time) + max(time, 1), p:max(vec3(0)) end
-- run: used p=-1,2,-3 time=4
-- expect: 14.5, 0, 2, 0
