-- Integers wrap and never fault but by division by zero.
function sums(frame, id) return frame + id, frame - id, frame * id, -frame end
-- run: sums frame=9223372036854775807 id=1
-- expect: -9223372036854775808, 9223372036854775806, 9223372036854775807, -9223372036854775807
-- run: sums frame=-9223372036854775808 id=-1
-- expect: 9223372036854775807, -9223372036854775807, -9223372036854775808, -9223372036854775808

function constants() return math.maxinteger + 1, math.mininteger - 1, math.mininteger * -1, 9223372036854775807 end
-- run: constants
-- expect: -9223372036854775808, 9223372036854775807, -9223372036854775808, 9223372036854775807

function mixed(frame, time) return frame + time, time - frame, frame * 0.5, frame / 2 end
-- run: mixed frame=3 time=0.5
-- expect: 3.5, -2.5, 1.5, 1.5
