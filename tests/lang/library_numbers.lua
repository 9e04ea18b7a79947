-- The library's functions of numbers.
function one(time)
  return abs(time), sign(time), floor(time), ceil(time), fract(time), round(time), trunc(time), saturate(time)
end
-- run: one time=-2.25
-- expect: 2.25, -1, -3, -2, 0.75, -2, -2, 0
-- run: one time=2.5
-- expect: 2.5, 1, 2, 3, 0.5, 3, 2, 1

function two(time, fw) return mod(time, fw), min(time, fw), max(time, fw), step(time, fw), pow(time, fw), atan(time, fw) end
-- run: two time=5 fw=3
-- expect: 2, 3, 5, 0, 125, 1.0303768265243125

function three(time, fw)
  return clamp(time, 0, 1), mix(time, fw, 0.25), smoothstep(0, 1, time), smootherstep(0, 1, time), linearstep(0, 2, time), pulse(0, 1, time)
end
-- run: three time=0.5 fw=2.5
-- expect: 0.5, 1, 0.5, 0.5, 0.25, 1

function shaped(time) return bias(time, 0.5), gain(time, 0.5), radians(time), degrees(time) end
function elementary(time) return exp(time), log(time), sqrt(time), inversesqrt(time), sin(time), cos(time), tan(time) end
function inverse(time) return asin(time), acos(time), atan(time) end
-- run: inverse time=1
-- expect: 1.5707963267948966, 0, 0.78539816339744828

function integers_too(frame) return abs(frame), floor(frame), max(frame, 2), mix(0, frame, 0.5), clamp(frame, 0, 3) end
-- run: integers_too frame=-3
-- expect: 3, -3, 2, -1.5, 0
