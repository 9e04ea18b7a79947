-- Precedence and associativity.
function arithmetic() return 2 + 3 * 4 ^ 2 / 2, -2 ^ 2, 7 - 2 - 1, 2 ^ 3 ^ 2, -3 % 5, -(3 % 5), 7 // 2 * 2 end
-- run: arithmetic
-- expect: 26, -4, 4, 512, 2, -3, 6
function bits() return 1 | 2 ~ 3 & 5, 1 << 2 + 1, ~0 >> 60, 6 & 3 << 1, 5 // 2 << 1, -1 >> 63 end
-- run: bits
-- expect: 3, 8, 15, 6, 4, 1
function logic(backface) return not backface == true, 1 < 2 == true, backface or true and false, 1 + 1 == 2 and 2 > 1 end
-- run: logic backface=true
-- expect: false, true, true, true
