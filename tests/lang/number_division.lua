-- / gives a number; // and % of numbers floor, with signs, infinities and NaN as Lua has them.
function divide(time, fw) return time / fw, time // fw, time % fw end
-- run: divide time=7 fw=2
-- expect: 3.5, 3, 1
-- run: divide time=-7.5 fw=2
-- expect: -3.75, -4, 0.5
-- run: divide time=7.5 fw=-2
-- expect: -3.75, -4, -0.5
-- run: divide time=1 fw=0
-- expect: inf, inf, nan
-- run: divide time=-1 fw=0
-- expect: -inf, -inf, nan
-- run: divide time=5 fw=inf
-- expect: 0, 0, 5
-- run: divide time=-5 fw=inf
-- expect: -0, -0, inf
-- run: divide time=5 fw=-inf
-- expect: -0, -0, -inf
-- run: divide time=-0.0 fw=1
-- expect: -0, -0, -0

function by_integer(time, frame) return time // frame, time % frame, frame // time, frame % time end
-- run: by_integer time=-7.5 frame=2
-- expect: -4, 0.5, -1, -5.5

function integers_over(frame, id) return frame / id end
-- run: integers_over frame=1 id=0
-- expect: inf
-- run: integers_over frame=9007199254740993 id=1
-- expect: 9007199254740992
