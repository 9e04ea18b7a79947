local
----
local 1
----
local x =
----
local x y
----
local x,
----
local x <foo> = 1
----
local x <const = 1
----
local x <> = 1
----
local x <close>, y <close> = nil, nil
----
local x <const> = 1; x = 2
----
local x <close> = nil; x = 2
----
local x <const> = 1; a, x = 1, 2
----
local x <const> = 1; return function() x = 2 end
----
local x <const> = 1; function x() end
----
local function
----
local function f.x() end
----
local function f
----
function
----
function f
----
function f(
----
function f( end
----
function f(a,) end
----
function f(..., a) end
----
function f(1) end
----
function f()
----
function f:a.b() end
----
function a[1]() end
----
f() = 1
----
a, f() = 1
----
f(), a = 1
----
(a) = 1
----
a.b:c = 1
----
1 = 2
----
"x" = 1
----
"x":f()
----
{}.x = 1
----
(f())
----
a
----
a.b
----
a + b
----
a, b
----
a =
----
a = b,
----
a = = b
----
= 1
----
a == 1
----
a != 1
----
a += 1
----
a++
----
break
----
do break end
----
while true do local f = function() break end end
----
if x then break end
----
goto
----
goto 1
----
goto l
----
do ::l:: end goto l
----
goto l; do ::l:: end
----
goto l; local x; ::l:: x = 1
----
goto l; local x; ::l:: ::m:: ; x = 1
----
goto l; local x <const> = 1; ::l:: f()
----
do goto l end local x ::l:: f()
----
goto l; local function f() end ::l:: f()
----
repeat goto l; local x; ::l:: until x
----
::l:: ::l::
----
::l:: do ::l:: end
----
::l
----
::l:
----
:: ::
----
::1::
----
goto l local function f() ::l:: end
----
local function f() goto l end ::l::
----
return return
----
return 1 2
----
return 1; ;
----
return; x = 1
----
return end
----
do return f() end x
----
if x
----
if x then
----
if x else end
----
if then end
----
if x then else elseif y then end
----
if x then else else end
----
elseif
----
end
----
do end end
----
do
----
do until x
----
while x
----
while x do
----
while do end
----
while x then end
----
repeat
----
repeat until
----
repeat end
----
until x
----
for
----
for x
----
for x do end
----
for 1 = 2, 3 do end
----
for x = 1 do end
----
for x = 1, 2, 3, 4 do end
----
for x, y = 1, 2 do end
----
for x in do end
----
for x, in y do end
----
for x in y
----
for x in y do
----
for a.b = 1, 2 do end
----
local function f() return ... end
----
function f() x = {...} end
----
local f = function(a) return function() return ... end end
----
x = 1 )
----
x }
----
then x = 1
----
in
----
local goto = 1
----
local end = 1
----
a.end = 1
----
x = {end = 1}
----
const x = 1
----
let x = 1;
----
local x <const> = 1; local function f() local function g() x = 1 end end
