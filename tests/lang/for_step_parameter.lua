-- A step that is a parameter: known only to the instance.
local stride = param("stride", 2)
local size = param("size", 0.5)
function integers(frame)
  local s = 0
  for k = 0, frame & 31, stride do s = s + k end
  return s
end
-- run: integers frame=10
-- expect: 30
-- run: integers frame=10 -D stride=5
-- expect: 15
-- run: integers frame=10 -D stride=-1
-- expect: 0
-- run: integers frame=10 -D stride=0
-- expect: fault: for-step
function numbers()
  local s = 0.0
  for x = 0.0, 2.0, size do s = s + x end
  return s
end
-- run: numbers
-- expect: 5
-- run: numbers -D size=0
-- expect: fault: for-step
