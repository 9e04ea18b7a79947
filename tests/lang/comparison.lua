-- Comparisons of numbers and integers, NaN included.
function numbers(time, fw) return time < fw, time <= fw, time > fw, time >= fw, time == fw, time ~= fw end
-- run: numbers time=1 fw=2
-- expect: true, true, false, false, false, true
-- run: numbers time=nan fw=nan
-- expect: false, false, false, false, false, true
-- run: numbers time=-0.0 fw=0
-- expect: false, true, false, true, true, false

function integers(frame, id) return frame < id, frame <= id, frame > id, frame >= id, frame == id, frame ~= id end
-- run: integers frame=-9223372036854775808 id=9223372036854775807
-- expect: true, true, false, false, false, true

function booleans(backface, frame) return backface == (frame > 0), backface ~= (frame > 0) end
-- run: booleans backface=true frame=1
-- expect: true, false
