-- Every form of numeral; large decimal integers become floats, hexadecimal ones wrap.
function integers() return 0, 0x7fffffffffffffff, 0xffffffffffffffff, 0xA, 1e2 // 1 == 100 end
-- run: integers
-- expect: 0, 9223372036854775807, -1, 10, true
function floats() return 3., .5, 1e-3, 0x.8p1, 0x1p-2, 9223372036854775808, 1e308 * 10, -1e308 * 10 end
-- run: floats
-- expect: 3, 0.5, 0.001, 1, 0.25, 9.2233720368547758e+18, inf, -inf
function wrapped() return 0x1ffffffffffffffff, 0xA.8, 0xAp0 end
-- run: wrapped
-- expect: -1, 10.5, 10
function kinds() return 1 == 1.0, math.type(1) == "integer", 2^53 == 2^53 + 1 end
