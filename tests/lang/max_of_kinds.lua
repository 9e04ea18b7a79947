-- math.max and math.min of an integer and a number give whichever it is: a mixed number.
function greatest(frame, time) return math.max(frame, time), math.min(frame, time), math.max(frame, 0.5) end
-- run: greatest frame=3 time=2.5
-- expect: 3, 2.5, 3
-- run: greatest frame=-3 time=2.5
-- expect: 2.5, -3, 0.5
function same_kind(frame, id) return math.max(frame, id) // 2, math.min(frame, id) % 3 end
-- run: same_kind frame=5 id=7
-- expect: 3, 2
