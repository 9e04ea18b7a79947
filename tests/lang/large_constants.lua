-- Comparisons with constants that only one of the two kinds can hold.
function below(frame) return frame < 9223372036854775808, frame <= 9223372036854775807.0, frame >= -9223372036854775808.0, frame > -9.3e18 end
-- run: below frame=9223372036854775807
-- expect: true, true, true, true
-- run: below frame=-9223372036854775808
-- expect: true, true, true, true
function half(frame) return frame < 0.5, frame > 0.5, frame < -0.5, frame == 9007199254740993, frame == 9007199254740992.0 end
-- run: half frame=9007199254740993
-- expect: false, true, false, true, false
function infinite(frame) return frame < math.huge, frame > -math.huge, frame == 1/0, frame ~= 0/0 end
-- run: infinite frame=9223372036854775807
-- expect: true, true, false, true
