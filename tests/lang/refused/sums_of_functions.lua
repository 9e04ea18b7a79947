local function two(a, b) return a + b end
local function vector(q) return q * 2 end
local function nothing(q) local x = q end
function height(p) return fbm(two, p) end
function f(p) return fbm(vector, p, 3) end
function g(p) return turbulence(dot, p) end
function h(p) return ridged(vec3, p) end
function k(p) return hybrid(sin, p) end
function l(p) return warp(noise) end
function m(p) return fbm(noise, p, p) end
function n(p) return fbm(noise, p, 1, 2, 3, 4, 5, 6) end
function o(p) return fbm(noise, true) end
function q(p) return fbm(nothing, p) end
local again
function again(q) return fbm(again, q) end
function r(p) return again(p) end
-- error: 4:31 sum-function
-- error: 5:26 sum-function
-- error: 6:33 sum-function
-- error: 7:29 sum-function
-- error: 8:29 sum-function
-- error: 9:22 missing-argument
-- error: 10:36 argument-type
-- error: 11:51 too-many-arguments
-- error: 12:33 argument-type
-- error: 13:26 sum-function
-- error: 15:26 recursion
