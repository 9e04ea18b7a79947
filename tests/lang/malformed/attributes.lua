local a <const> = 1
a = 2
local b <constant> = 3
local c <close>, d <close> = 1, 2
local function f() return ... end
-- error: 2:1 assign-to-const
-- error: 3:10 unknown-attribute
-- error: 4:21 several-close
-- error: 5:27 vararg-outside
