-- A component by an index that depends on the point; outside, the point faults.
function pick(p, id) return p[id] end
function sum(p, uv)
  local s = 0.0
  local q = vec4(p, uv.x)
  for i = 1, 4 do s = s * 2 + q[i] end
  for i = 1, 2 do s = s + uv[i] end
  return s
end
function by_number(p, time) return p[time], p[2.0] end
function nested(p, id) return vec3(p[id % 3 + 1], p[(id + 1) % 3 + 1], p[(id + 2) % 3 + 1]) end
-- run: pick p=5,6,7 id=1
-- expect: 5
-- run: pick p=5,6,7 id=3
-- expect: 7
-- run: pick p=5,6,7 id=0
-- expect: fault: index
-- run: pick p=5,6,7 id=4
-- expect: fault: index
-- run: by_number p=5,6,7 time=2
-- expect: 6, 6
-- run: nested p=5,6,7 id=4
-- expect: 6, 7, 5
-- run: by_number p=5,6,7 time=2.5
-- expect: fault: integer-range
-- run: by_number p=5,6,7 time=4
-- expect: fault: index
-- run: by_number p=5,6,7 time=nan
-- expect: fault: integer-range
