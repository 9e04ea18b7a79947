function height(p)
  coroutine.yield(p.x)
  return p.x
end
-- error: 2:3 coroutines
