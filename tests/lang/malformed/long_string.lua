-- error: 2:11 unfinished-long-string
local a = [==[ never closed ]=]
