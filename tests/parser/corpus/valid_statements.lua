
----
;;; ; ;
----
local a
----
local a, b, c = 1, 2
----
local a <const> = 1
----
local a <const>, b <close>, c = nil, nil, nil
----
local a < const >, b<close> = 1
----
local const, close = 1, 2; const = close
----
a, b.c, d[e], f().g, ("x").y = 1
----
(a).b = 1; (a.b)[1] = 2; (f()).x = 3
----
a.b"x"{}.c = 1
----
f() g{} h"x" i'y' j[[z]] k:l() m.n:o{} p:q"r"
----
f
(g or h)()
----
do end do local x end do do do end end end
----
while true do break end
----
while x do if y then break end z() end
----
repeat local x = f() until x
----
repeat break until false
----
if a then elseif b then elseif c then else end
----
for i = 1, 2 do end for i = 1, 2, 3 do i = i + 1 end
----
for k in pairs(t) do end for a, b, c in x, y, z do local a = a end
----
function f() end function a.b.c.d() end function a:m() return self end function a.b:c(...) end
----
local function f(a, b, ...) return f, ... end
----
local f = function(...) return ... end
----
return
----
return;
----
return 1, 2, ...;
----
do return end x = 1
----
if x then return else return 1 end
----
goto l; ::l::
----
::l:: goto l
----
do goto l end ::l::
----
goto a; local x; ::a:: ; ::b::
----
do goto a; local x; ::a:: end
----
do goto a end; local x; ::a::
----
do ::a:: end ::a:: do ::a_:: end
----
::a:: return function() ::a:: goto a end
----
while x do goto continue; local y; ::continue:: end
----
for i = 1, 3 do if i == 2 then goto next end print(i) ::next:: end
----
repeat if x then goto continue end; ::continue:: until y
----
repeat goto a; ::a:: local x until x
----
local x <const> = 1; do local x = 2; x = 3 end
----
local x <const> = {}; x.y = 1; x[1] = 2; function x.f() end function x:m() end
----
local x <const> = 1; local function f(x) x = 2 end
----
local _ENV = {}; x = 1
----
local _ENV <const> = {}; x = y; local function f() return z end
----
_ENV.x = 1; _ENV = nil
----
goto_ = 1; End = 2; and_ = 3
----
local function f() return f() end local function g() return function() return g end end
----
break_ = 1 while 1 do break; end
----
while 1 do break local x end
----
#!/usr/bin/env lua
return 1
----
# the first line is skipped
----
#
