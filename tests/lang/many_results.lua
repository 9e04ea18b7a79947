-- Results of every type share a row.
function every(p, uv, time, frame, backface) return backface, frame, time, uv, p, vec4(p, time) end
-- run: every p=1,2,3 uv=4,5 time=6.5 frame=-7 backface=true
-- expect: true, -7, 6.5, 4, 5, 1, 2, 3, 1, 2, 3, 6.5
function only_boolean(backface) return not backface end
-- run: only_boolean backface=true
-- expect: false
