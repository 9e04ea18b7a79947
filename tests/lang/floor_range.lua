-- math.floor and math.ceil at the edges of the integers; beyond them the point faults.
function floors(time) return math.floor(time) end
-- run: floors time=9223372036854774784
-- expect: 9223372036854774784
-- run: floors time=9223372036854775808
-- expect: fault: integer-range
-- run: floors time=-9223372036854775808
-- expect: -9223372036854775808
-- run: floors time=-9223372036854777856
-- expect: fault: integer-range
-- run: floors time=inf
-- expect: fault: integer-range
function ceils(time) return math.ceil(time) end
-- run: ceils time=-0.5
-- expect: 0
-- run: ceils time=9223372036854775807
-- expect: fault: integer-range
function guarded(time) return time == time and abs(time) < 1e15 and math.floor(time) & 1 or -1 end
-- run: guarded time=nan
-- expect: -1
-- run: guarded time=-3.5
-- expect: 0
