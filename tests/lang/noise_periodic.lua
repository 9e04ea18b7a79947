-- Periodic noise: the same after a period, also where the period differs by point.
local tile = param("tile", 4, { min = 1, max = 64 })

function repeats(uv)
  local period = vec2(4, 3)
  local q = uv + vec2(8, -6)
  local same = cellnoise(uv) ~= cellnoise(q) and pcellnoise(uv, period) == pcellnoise(q, period)
  return same, pvaluenoise(uv, period) - pvaluenoise(q, period)
end
-- run: repeats uv=0.25,0.5
-- expect: true, 0

function families(p, uv, time)
  local size = vec3(tile)
  return pnoise(p, size), pperlin(p, size), pvaluenoise(p, size), pcellnoise(p, size), pgabor(uv, vec2(tile), 2), pnoise(time, tile), pnoise(uv, vec2(tile))
end
function of_four(p, time) return pnoise(vec4(p, time), vec4(tile)), pperlin(vec4(p, time), vec4(tile, tile, 2, 7)) end
function worleys(p, uv)
  local f1, f2, id = pworley(p, vec3(tile))
  return f1, f2, id, (pworley(uv, vec2(3, 5), 1))
end
-- Below 1, no number and beyond all numbers are periods too.
function odd_periods(p, time) return pnoise(p, vec3(time, 0, -3.5)), pcellnoise(p, p), pvaluenoise(time, p.x) end
