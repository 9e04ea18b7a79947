-- What ramp and its like do not take.
local T = { 1, 2, 3 }
local R = { a = 1 }
local F = { true, false }
function height(p) return ramp(p, T) end
function f(p) return ramp(p.x, R) end
function g(p) return ramp(p.x, F) end
function h(p) return catmullrom(p.x, T) end
function k(p) return ramp(p.x) end
function l(p) return ramp(p.x, T, 1) end
function m(p) return ramp(p.x, 3) end
-- error: 5:32 argument-type
-- error: 6:32 argument-type
-- error: 7:32 argument-type
-- error: 8:38 argument-type
-- error: 9:22 missing-argument
-- error: 10:35 too-many-arguments
-- error: 11:32 argument-type
