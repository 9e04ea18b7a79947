x = 1 + 2 - 3 * 4 / 5 // 6 % 7 ^ 8
----
x = 1 & 2 | 3 ~ 4 << 5 >> 6
----
x = ~1 ~= ~2 == not 3
----
x = a and b or c and not d
----
x = -2 ^ 2 ^ -3
----
x = - - - 1 y = not not not nil z = ~ ~ 1 w = # # t
----
x = "a" .. "b" .. 1 + 2 .. "c"
----
x = a < b, a <= b, a > b, a >= b, a == b, a ~= b
----
x = (((((1)))))
----
x = f(g(h(i))), f{g{h{}}}, f"x""y""z"
----
x = (f)(1)(2)(3):m(4).n[5]
----
x = function() return function() return function(...) return ... end end end
----
x = {f = function() end, g = function(...) end, [function() end] = 1}
----
x = ("x"):rep(3) y = ({1, 2})[1] z = (function() end)()
----
x = #t.a.b[1] y = -f(x) z = -x.y ^ 2
----
x = a.and_ y = a.b:c(1):d(2)
----
x = ... y = (...)
