-- Arrays of values: along lines, round and round, by splines; constants of the top level and arrays made at the point.
local SUNSET <const> = { rgb(0.1, 0.1, 0.3), rgb(0.9, 0.4, 0.1), rgb(1, 0.9, 0.6) }
local HEIGHTS = { 0, 1, 4, 9, 16 }
local ONE = { 7.5 }
local FLAGS = { { shades = { vec2(0, 1), vec2(1, 0), vec2(2, 3), vec2(4, 4) } }, { shades = { vec2(1), vec2(2), vec2(3), vec2(4) } } }

function colors(p) return ramp(p.x, SUNSET), palette(p.y, SUNSET), palette(p.x, p, p, p, p) end

function numbers(p, time) return ramp(time, HEIGHTS), palette(time, HEIGHTS), catmullrom(time, HEIGHTS), bspline(time, HEIGHTS), ramp(p.x, ONE) end

function made_here(p, n)
  local t = { p, n, p + n, p * 2, n - p }
  return ramp(p.x, t), palette(n.x, t), catmullrom(p.y, t), bspline(p.z, t), bspline(p.x, p, n, p, n)
end

function nested(p, frame)
  local flag = p.x > 0 and 1 or 2
  return ramp(p.y, FLAGS[1].shades), catmullrom(p.y, FLAGS[2].shades), ramp(0.5, HEIGHTS) + flag
end

function known(p) return ramp(p.x, HEIGHTS), ramp(0, HEIGHTS), ramp(1, HEIGHTS), ramp(9, HEIGHTS), ramp(-1, HEIGHTS), palette(0.9, HEIGHTS), palette(1.9, HEIGHTS), catmullrom(0, HEIGHTS), catmullrom(1, HEIGHTS), ramp(0.3, ONE), palette(0.3, ONE) end
-- run: known p=0.375,0,0
-- expect: 2.5, 0, 16, 16, 0, 8, 8, 1, 9, 7.5, 7.5
