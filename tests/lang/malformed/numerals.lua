local a = 3x
local b = 0x
local c = 1e+
local d = 1..2
-- error: 1:11 malformed-number
-- error: 2:11 malformed-number
-- error: 3:11 malformed-number
-- error: 4:11 malformed-number
