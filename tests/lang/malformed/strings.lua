local a = "unfinished
local b = 'escape \q'
local c = [==x
-- error: 1:11 unfinished-string
-- error: 2:19 invalid-escape
-- error: 3:11 invalid-long-bracket
