function height(p)
  local k = 0.0
  if p.x > 0 then goto middle end
  k = 1.0
  ::middle::
  k = k + 1
  return k
end
-- error: 3:19 goto-form
