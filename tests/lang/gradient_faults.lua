-- A fault inside the function of a gradient ends the point, as it does in a call; steps count as those of one call.
-- mild
-- near: 1e-6
-- steps: 60
function divides(p, frame)
  return gradient(function(q) return q.x * (7 // frame) end, p)
end

function asserts(p, id)
  return gradient(function(q)
    assert(id > 0, "no object")
    return q.x * q.y
  end, p)
end

function long(p, frame)
  return gradient(function(q)
    local s = 0.0
    for i = 1, frame * 10 do s = s + q.x * i end
    return s
  end, p)
end

-- run: long p=1,2,3 frame=5
-- expect: 1275, 0, 0
-- run: long p=1,2,3 frame=6
-- expect: fault: step-limit
-- run: divides p=1,2,3 frame=0
-- expect: fault: division
