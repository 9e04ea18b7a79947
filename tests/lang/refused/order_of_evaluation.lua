function height(p)
  local n = 0.0
  local function bump()
    n = n + 1
    return n
  end
  return n + bump() * n
end
-- error: 7:10 order-of-evaluation
-- error: 7:23 order-of-evaluation
