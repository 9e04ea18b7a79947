-- An integer is compared with a number exactly, not after rounding.
function compare(frame, time) return frame < time, frame <= time, frame > time, frame >= time, frame == time, frame ~= time end
-- run: compare frame=9007199254740993 time=9007199254740992
-- expect: false, false, true, true, false, true
-- run: compare frame=9007199254740992 time=9007199254740992
-- expect: false, true, false, true, true, false
-- run: compare frame=9223372036854775807 time=9223372036854775808
-- expect: true, true, false, false, false, true
-- run: compare frame=-9223372036854775808 time=-9223372036854775808
-- expect: false, true, false, true, true, false
-- run: compare frame=0 time=nan
-- expect: false, false, false, false, false, true
-- run: compare frame=9223372036854775807 time=inf
-- expect: true, true, false, false, false, true

function turned(frame, time) return time < frame, time <= frame, time > frame, time >= frame, time == frame end
-- run: turned frame=3 time=2.5
-- expect: true, true, false, false, false

function constants(frame) return frame < 0.5, frame == 2.0, frame >= 1e300, frame > -1e300 end
-- run: constants frame=2
-- expect: false, true, false, true
