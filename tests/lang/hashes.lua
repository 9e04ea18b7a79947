-- Hashes of integers, numbers and vectors.
function hashes(frame, time, p, uv) return hash(frame), hash(time), hash(p), hash(uv), hash(vec4(p, time)) end
function alike(frame) return hash(frame) == hash(frame + 0.0), hash(0.0) == hash(-0.0) end
-- run: alike frame=5
-- expect: true, true
function cells(p) return hash(floor(p)), hash(floor(p * 4)) < 0.5 end
