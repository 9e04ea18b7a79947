-- c and a or b, and chains of it.
function choose(time, backface) return backface and time or -time end
-- run: choose time=2 backface=true
-- expect: 2
-- run: choose time=2 backface=false
-- expect: -2

function chain(time) return time < 0 and -1.0 or time < 1 and 0.5 or time < 2 and 1.5 or 9.0 end
-- run: chain time=-3
-- expect: -1
-- run: chain time=0.5
-- expect: 0.5
-- run: chain time=1
-- expect: 1.5
-- run: chain time=nan
-- expect: 9

function compound(time, fw) return time > 0 and fw > 0 and time * fw or 0.25 end
-- run: compound time=2 fw=3
-- expect: 6
-- run: compound time=2 fw=-3
-- expect: 0.25

function of_vectors(p, backface) return backface and p * 2 or vec3(1, 2, 3) end
-- run: of_vectors p=1,1,1 backface=true
-- expect: 2, 2, 2

-- only the chosen side runs
function lazily(frame, id) return id ~= 0 and frame // id or -1 end
-- run: lazily frame=9 id=0
-- expect: -1
-- run: lazily frame=9 id=2
-- expect: 4
