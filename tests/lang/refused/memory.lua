local count = 0
function height(p)
  count = count + 1
  return count
end
-- error: 3:3 shader-has-no-memory
