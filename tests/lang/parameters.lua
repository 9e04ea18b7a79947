-- Parameters are data of the instance.
local scale = param("scale", 4.0, { min = 0.1, max = 40, doc = "size" })
local count = param("count", 3)
local enabled = param("enabled", true)
local tint = param("tint", vec3(1, 0.5, 0.25))
local wide = scale * 2

function numbers() return scale, wide, count, enabled end
-- run: numbers
-- expect: 4, 8, 3, true
-- run: numbers -D scale=0.5 -D count=-7 -D enabled=false
-- expect: 0.5, 1, -7, false

function vectors(time) return tint * time end
-- run: vectors time=2
-- expect: 2, 1, 0.5
-- run: vectors time=2 -D tint=0.25,0,-1
-- expect: 0.5, 0, -2

function loops()
  local sum = 0
  for k = 1, count do sum = sum + k end
  return sum
end
-- run: loops
-- expect: 6
-- run: loops -D count=100
-- expect: 5050
