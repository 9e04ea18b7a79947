local function f(x)
  break
  goto nowhere
  goto inside
  local y = x
  ::inside::
  ::inside::
  return y
end
-- error: 2:3 break-outside-loop
-- error: 3:8 undefined-label
-- error: 4:3 goto-into-scope
-- error: 7:5 duplicate-label
