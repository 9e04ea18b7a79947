-- A global that hides a name of the library is the library's until it gets its value; a function sees what it is when
-- it is called.
local old = noise
local before = noise(vec3(0.25, 0.5, 0.75))
local function probe(p) return noise(p) end
local probed = probe(vec3(0.25, 0.5, 0.75))

function height(p) return noise(p) end
-- run: height p=0.25,0.5,0.75
-- expect: 1000

function noise(p) return p.x * 4000 + old(p) * 0 end

local after = noise(vec3(0.25, 0.5, 0.75))
local probed_after = probe(vec3(0.25, 0.5, 0.75))
function tops(p) return before == probed, before == old(p), after, probed_after end
-- run: tops p=0.25,0.5,0.75
-- expect: true, true, 1000, 1000

mix = mix
function mixed(time) return mix(1, 3, time) end
-- run: mixed time=0.5
-- expect: 2

-- Each takes the name of the other.
sin, cos = cos, sin
function exchanged(time) return sin(time), cos(time) end
-- run: exchanged time=0
-- expect: 1, 0

local clamped = clamp(5, 0, 2)
clamp = clamped + clamp(7, 0, 3)
local squares = 0.0
for k = 1, 3 do squares = squares + step(2, k) end
step = squares
function numbers(time) return clamp, step end
-- run: numbers time=0
-- expect: 5, 2

local pi = math.pi
math = { floor = 3, other = math.floor(2.5) }
function tables(time) return math.floor + math.other + pi - pi end
-- run: tables time=0
-- expect: 5

perlin_of_library = perlin
function alias(p) return perlin_of_library(p) == perlin(p) end
-- run: alias p=0.1,0.2,0.3
-- expect: true

do
  local kept = length
  function length(v) return kept(v) + 1 end
end
function lengths(p) return length(p), p:length() end
-- run: lengths p=3,4,0
-- expect: 6, 5

local scale = param("scale", vec3(1, 2, 3))
function vec3(x) return x end
function constructed(time) return vec3(time) + scale.z end
-- run: constructed time=1
-- expect: 4

local total = 0
for _, v in ipairs({ 1, 2, 3 }) do total = total + v end
function ipairs(x) return x + total end
function looped(time) return ipairs(time) end
-- run: looped time=1
-- expect: 7

local function twice(f, x) return f(f(x)) end
local root = twice(sqrt, 16.0)
function sqrt(x) return x + 1 end
local sum = twice(sqrt, 16.0)
function applied(time) return root, sum, twice(sqrt, time) end
-- run: applied time=1
-- expect: 2, 18, 3
