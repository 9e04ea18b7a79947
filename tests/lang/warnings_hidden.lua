-- Names of the library that the shader hides and then calls; a local that stands for a function of the library, a
-- name that is not called and one that begins with '_' are all right.
local sin = math.sin
local floor = floor
local length = 2

local function noise(x) return x * 3 end
function clamp(a) return a end

function height(p)
  local function fract(x) return x + 1 end
  local mix = function(a, b) return a - b end
  local step = p.y
  local function apply(max) return max end
  return noise(p.x) + clamp(p.y) + fract(p.z) + mix(1, 2) + sin(0) + floor(p.x) + length + step + apply(1)
end
-- run: height p=1,2,3
-- expect: 14
-- warning: 7:16 hidden-library-name
-- warning: 8:10 hidden-library-name
-- warning: 11:18 hidden-library-name
-- warning: 12:9 hidden-library-name

-- Called above its definition alone, and a global name for the library's own.
local above = max(1, 2)
function max(a) return a + above end
saturate = saturate
function ends(p) return saturate(p.x) end
