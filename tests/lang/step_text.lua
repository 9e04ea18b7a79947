#!/usr/bin/env lua
-- Texts that counting steps must leave alone: strings, comments, and bodies on one line.
-- steps: 12
local s --[[ function() while true do end ]] = 0
--[==[ for k = 1, 2 do
]] repeat ]==]
local function f(x) return x end local function g(x)return f(x)end
function one_line(frame) local n=s while n<frame do n=n+1 end;repeat n=n+g(1)until n>frame or n>40;return n end
-- run: one_line frame=3
-- expect: 4
-- run: one_line frame=9
-- expect: fault: step-limit
function message(time) assert(time > 0, "while true do end") return time end
-- run: message time=2
-- expect: 2
