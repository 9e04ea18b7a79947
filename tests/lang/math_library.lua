-- Lua's own math library keeps its argument and result types.
function kinds(time, frame) return math.floor(time), math.ceil(time), math.abs(frame), math.abs(time), math.max(frame, 3), math.min(time, 0.5) end
-- run: kinds time=-2.5 frame=-9223372036854775808
-- expect: -3, -2, -9223372036854775808, 2.5, 3, -2.5
-- run: kinds time=1e300 frame=1
-- expect: fault: integer-range
-- run: kinds time=nan frame=1
-- expect: fault: integer-range

function of_integers(frame) return math.floor(frame), math.ceil(frame) end
-- run: of_integers frame=-9223372036854775808
-- expect: -9223372036854775808, -9223372036854775808

function elementary(time)
  return math.sin(time), math.cos(time), math.tan(time), math.exp(time), math.sqrt(time), math.log(time), math.atan(time)
end
function angles(time, fw) return math.atan(time, fw), math.deg(time), math.rad(time), math.asin(time), math.acos(time), math.log(time, 2), math.log(time, 10) end
-- run: angles time=1 fw=-1
-- expect: 2.3561944901923448, 57.295779513082323, 0.017453292519943295, 1.5707963267948966, 0, 0, 0
function rests(time, fw) return math.fmod(time, fw) end
-- run: rests time=-7 fw=3
-- expect: -1
function integer_rests(frame, id) return math.fmod(frame, id) end
-- run: integer_rests frame=-7 id=3
-- expect: -1
-- run: integer_rests frame=-9223372036854775808 id=-1
-- expect: 0
-- run: integer_rests frame=1 id=0
-- expect: fault: division
function unsigned(frame, id) return math.ult(frame, id) end
-- run: unsigned frame=1 id=-1
-- expect: true
function constants() return math.pi, math.huge, -math.huge, math.maxinteger, math.mininteger end
-- run: constants
-- expect: 3.1415926535897931, inf, -inf, 9223372036854775807, -9223372036854775808
