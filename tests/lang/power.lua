-- ^ is always of numbers; x^2 is x*x.
function powers(time, fw) return time ^ fw, time ^ 2, time ^ 0.5, time ^ -1, 2 ^ fw end
-- run: powers time=3 fw=4
-- expect: 81, 9, 1.7320508075688772, 0.33333333333333331, 16
-- run: powers time=-8 fw=3
-- expect: -512, 64, nan, -0.125, 8

function of_integers(frame) return frame ^ 2, frame ^ 3, -frame ^ 2, 2 ^ -frame end
-- run: of_integers frame=-3
-- expect: 9, -27, -9, 8

function right_associative(time) return time ^ 2 ^ 0.5, (time ^ 2) ^ 0.5, -time ^ 2 end
-- run: right_associative time=-2
-- expect: nan, 2, -4
