local function even(n)
  if n == 0 then return 1 end
  return odd(n - 1)
end
function odd(n)
  return even(n)
end
function height(p)
  return even(p.x)
end
-- error: 6:10 recursion
