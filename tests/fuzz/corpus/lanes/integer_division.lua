-- // and % of integers floor; a zero divisor faults.
function divide(frame, id) return frame // id, frame % id end
-- run: divide frame=7 id=2
-- expect: 3, 1
-- run: divide frame=-7 id=2
-- expect: -4, 1
-- run: divide frame=7 id=-2
-- expect: -4, -1
-- run: divide frame=-7 id=-2
-- expect: 3, -1
-- run: divide frame=-9223372036854775808 id=-1
-- expect: -9223372036854775808, 0
-- run: divide frame=5 id=-9223372036854775808
-- expect: -1, -9223372036854775803
-- run: divide frame=1 id=0
-- expect: fault: division

function modulo_only(frame, id) return frame % id end
-- run: modulo_only frame=-9223372036854775808 id=-1
-- expect: 0
-- run: modulo_only frame=4 id=0
-- expect: fault: division

function by_constants(frame) return frame // 3, frame % 3, frame // -3, frame % -3, frame // -1, frame % -1, frame // 1, frame % 1 end
-- run: by_constants frame=-9223372036854775808
-- expect: -3074457345618258603, 1, 3074457345618258602, -2, -9223372036854775808, 0, -9223372036854775808, 0
