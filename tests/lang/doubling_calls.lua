-- Functions that call others twice, level after level: a limit on steps, and code that does not double with each.
-- mild
-- steps: 3000
local function f0(x) return x + 1 end
local function f1(x) return f0(x) + f0(x * 0.5) end
local function f2(x) return f1(x) + f1(x * 0.5) end
local function f3(x) return f2(x) + f2(x * 0.5) end
local function f4(x) return f3(x) + f3(x * 0.5) end
local function f5(x) return f4(x) + f4(x * 0.5) end
local function f6(x) return f5(x) + f5(x * 0.5) end
local function f7(x) return f6(x) + f6(x * 0.5) end
local function f8(x) return f7(x) + f7(x * 0.5) end
local function f9(x) return f8(x) + f8(x * 0.5) end
local function f10(x) return f9(x) + f9(x * 0.5) end
local function f11(x) return f10(x) + f10(x * 0.5) end
local function f12(x) return f11(x) + f11(x * 0.5) end
local function f13(x) return f12(x) + f12(x * 0.5) end
local function f14(x) return f13(x) + f13(x * 0.5) end
function all(p) return f14(p.x) end
-- run: all p=1,2,3
-- expect: fault: step-limit
function fewer(p) return f10(p.x) end
-- run: fewer p=0,2,3
-- expect: 1024
