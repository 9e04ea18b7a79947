-- What no optimiser may simplify: signed zeros, NaN, infinities.
function signs(time) return time + 0.0, time - 0.0, 0.0 - time, -time, time * 0.0, 0.0 / time, time * 1, time / 1 end
-- run: signs time=-0.0
-- expect: 0, -0, 0, 0, -0, nan, -0, -0
function selves(time) return time - time, time / time, time == time, time ~= time, time < time, time <= time end
-- run: selves time=inf
-- expect: nan, nan, true, false, false, true
-- run: selves time=nan
-- expect: nan, nan, false, true, false, false
function order(time, fw) return (time + fw) - fw, time + (fw - fw), (time * fw) / fw, time * fw + time end
-- run: order time=1 fw=1e300
-- expect: 0, 1, 1, 1.0000000000000001e+300
function constants() return 0.0 / 0.0 ~= 0.0 / 0.0, -0.0, 1 / -0.0, 0.1 + 0.2, 1e308 + 1e308 end
-- run: constants
-- expect: true, -0, -inf, 0.30000000000000004, inf
function minimums(time, fw) return min(time, fw), max(time, fw), clamp(time, fw, 1), math.min(time, fw), math.max(time, fw) end
