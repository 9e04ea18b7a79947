-- contours.lua: a relief map whose contour lines are as wide at the horizon as at one's feet
local scale  = param("scale", 0.45, { min = 0.01, max = 20, doc = "hills a unit of length" })
local relief = param("relief", 0.55, { min = 0, max = 4, doc = "height of the hills" })
local lines  = param("lines", 12, { min = 1, max = 100, doc = "contour lines from the valleys to the tops" })
local width  = param("width", 0.8, { min = 0.1, max = 10, doc = "half a line's width, in pixels" })

local INK    <const> = rgb(0.11, 0.06, 0.03)
local VALLEY <const> = rgb(0.16, 0.30, 0.10)
local SLOPE  <const> = rgb(0.55, 0.42, 0.20)
local TOP    <const> = rgb(0.80, 0.78, 0.72)

local function hills(p)
  return fbm(vec3(p.x, 0.37, p.z) * scale, 4)
end

-- counts the contour lines from below
local function level(p)
  return hills(p) * lines
end

function height(p)
  return relief * hills(p)
end

function color(p, fw)
  local h = hills(p)
  local ground = mix(mix(VALLEY, SLOPE, smoothstep(-0.5, 0.1, h)), TOP, smoothstep(0.15, 0.65, h))
  -- how much the level changes over a pixel turns distances between levels into pixels
  local pixel = fwidth(level, p, fw)
  local distance = abs(fract(level(p) + 0.5) - 0.5)
  local line = 1 - aastep(width * pixel, distance, pixel)
  -- lines closer than pixels fade to their average
  line = mix(line, min(1, 2 * width * pixel), smoothstep(0.25, 0.6, pixel))
  return mix(ground, INK, 0.85 * line)
end
