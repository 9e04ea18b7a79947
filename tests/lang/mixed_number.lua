-- A variable that is given integers and numbers is a number.
-- mild
function summed(p)
  local s = 0
  for k = 1, 4 do s = s + p.x * k end
  return s
end
-- run: summed p=0.5,0,0
-- expect: 5

function either(time, backface)
  local x = 1
  if backface then x = time end
  return x * 2
end
-- run: either time=0.25 backface=true
-- expect: 0.5
-- run: either time=0.25 backface=false
-- expect: 2

local function pick(c, a)
  if c then return 0 end
  return a
end
function of_results(time, backface) return pick(backface, time) + 1 end
-- run: of_results time=0.5 backface=false
-- expect: 1.5
-- run: of_results time=0.5 backface=true
-- expect: 1

function color(p) return vec3(1, 0, p.x) end
-- run: color p=3,0,0
-- expect: 1, 0, 3

function height(frame) return frame end
-- run: height frame=3
-- expect: 3
