-- Shifts are logical; counts of 64 and more give 0, negative ones shift the other way.
function shift(frame, id) return frame << id, frame >> id end
-- run: shift frame=1 id=63
-- expect: -9223372036854775808, 0
-- run: shift frame=-1 id=64
-- expect: 0, 0
-- run: shift frame=-1 id=-1
-- expect: 9223372036854775807, -2
-- run: shift frame=-1 id=1
-- expect: -2, 9223372036854775807
-- run: shift frame=5 id=9223372036854775807
-- expect: 0, 0
-- run: shift frame=5 id=-9223372036854775808
-- expect: 0, 0

function by_constants(frame) return frame << 0, frame << 64, frame >> 64, frame << -64, frame >> 63, frame >> -3, frame << 100 end
-- run: by_constants frame=-1
-- expect: -1, 0, 0, 0, 1, -8, 0
