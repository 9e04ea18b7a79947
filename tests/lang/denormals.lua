-- Denormal numbers are kept, in both precisions.
function doubles(time) return time * 1e-310, 1e-310 * 0.5, 0x1p-1074, 0x1p-1074 / 2, time * 0x1p-1074 end
-- run: doubles time=1
-- expect: 9.9999999999999694e-311, 5.0000000000002318e-311, 4.9406564584124654e-324, 0, 4.9406564584124654e-324
function floats(time) return time * 1e-40, 1e-40 + 1e-42, time * 1e-45, abs(time) * 1e-38 * 1e-3 end
function ordered(time) return time * 1e-320 > 0, time * 1e-44 > 0, 1e-40 == 0 end
