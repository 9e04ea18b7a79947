-- and, or and not on booleans; the right side runs only where Lua runs it.
function combine(backface, frame)
  local odd = frame % 2 == 1
  return backface and odd, backface or odd, not backface, not (backface and not odd) or frame == 0
end
-- run: combine backface=true frame=2
-- expect: false, true, false, false

function guarded(frame, id) return id ~= 0 and frame // id > 1 end
-- run: guarded frame=4 id=0
-- expect: false
-- run: guarded frame=4 id=2
-- expect: true

function guarded_or(frame, id) return id == 0 or frame % id == 0 end
-- run: guarded_or frame=4 id=0
-- expect: true

function chain(time) return time > 0 and time < 1 or time > 2 and time < 3 end
-- run: chain time=2.5
-- expect: true
-- run: chain time=1.5
-- expect: false
