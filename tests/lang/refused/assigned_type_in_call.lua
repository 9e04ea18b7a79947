function height(p)
  local function f(a)
    p = 1.5
    return a
  end
  local g = f(1.5)
  return g
end
-- error: 3:9 type-conflict
