-- math.modf: an integer and the rest, as Lua has them; a fault where no integer is.
function split(time) return math.modf(time) end
function whole(time) local i = math.modf(time) return i // 2, math.type(i) == "integer" end
function of_integers(frame) return math.modf(frame) end
function of_mixed(time, frame)
  local m = 1
  m = m + time
  return math.modf(m)
end
function rest(p) return select_rest(p.x) end
function select_rest(x)
  local _, r = math.modf(x)
  return r
end
-- run: split time=3.75
-- expect: 3, 0.75
-- run: split time=-3.75
-- expect: -3, -0.75
-- run: split time=-0.5
-- expect: 0, -0.5
-- run: split time=inf
-- expect: fault: integer-range
-- run: split time=nan
-- expect: fault: integer-range
-- run: split time=1e300
-- expect: fault: integer-range
-- run: of_integers frame=-9223372036854775808
-- expect: -9223372036854775808, 0
