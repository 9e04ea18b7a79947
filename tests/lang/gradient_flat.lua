-- Derivatives of functions that do not change, of what changes without bound or has no slope: no NaN.
-- near: 1e-6

-- run: saturated
-- expect: 2
function saturated()
  return gradient(function(x) return smoothstep(0, 1, x / 0) + 2 * x end, 3.0)
end

-- run: cut
-- expect: 1
function cut()
  return gradient(function(x) return min(exp(x * 1000), 5.0) + clamp(x / 0, -1, 1) + x end, 2.0)
end

-- run: shaped
-- expect: 3
function shaped()
  return gradient(function(x) return bias(x, 0) + gain(0.25, x * 0) + 3 * x end, 0.5)
end

-- run: power_of_negative
-- expect: 48, 0
function power_of_negative()
  local exponent = 3.0
  return gradient(function(q)
    local n = exponent
    if q.y > 10 then n = q.y end
    return (q.x - 5) ^ n
  end, vec2(1, 2))
end

-- run: angle
-- expect: 1
function angle()
  return gradient(function(x) return atan(x, 1e200) + x end, 1.0)
end
