for k = 1, 2 do local x = param("x", k) end
function height(p)
  return param("y", 1)
end
-- error: 1:27 parameter-place
-- error: 3:10 parameter-place
