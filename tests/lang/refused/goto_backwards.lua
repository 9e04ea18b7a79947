function height(p)
  local k = 0
  ::again::
  k = k + 1
  if k < 3 then goto again end
  return k
end
-- error: 5:17 goto-form
