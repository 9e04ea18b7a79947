x = +1
----
x = 1 +
----
x = * 2
----
x = 1 2
----
x = a b
----
x = (1
----
x = (1, 2)
----
x = ()
----
x = f(
----
x = f(1,)
----
x = f(,)
----
x = {
----
x = {1, 2
----
x = {,}
----
x = {1,,2}
----
x = {;}
----
x = {a = }
----
x = {[1] 2}
----
x = {[1 = 2}
----
x = {a.b = 1}
----
x = {1 2}
----
x = a[
----
x = a[]
----
x = a[1
----
x = a.1
----
x = a.
----
x = a:
----
x = a:1()
----
x = a:b.c()
----
x = a.b:c.d
----
x = 1.f()
----
x = 1:f()
----
x = nil.x
----
x = {}.x
----
x = "s".x
----
x = function
----
x = function()
----
x = function f() end
----
x = function() end end
----
x = function(a b) end
----
x = not
----
x = a and
----
x = and b
----
x = a <> b
----
x = a === b
----
x = a ~ = b
----
x = a < = b
----
x = ... ...
----
x = local y
----
x = if a then b end
----
x = (a)) y = 1
----
f(a b)
----
f(a, b
g()
----
f{a, b
g()
