-- Comparisons of constant strings, known while compiling.
local mode = "fast"
function orders(p)
  return "a" < "b", "a" <= "a", "Z" > "a", "a\0b" < "a\0c", "" < "a", "ab" >= "abc", "\xff" > "a", "a" ~= "b"
end
-- run: orders p=0,0,0
-- expect: true, true, false, true, true, false, true, true

function chosen(time)
  if mode < "g" and not (mode > "g") then return time end
  return -time
end
-- run: chosen time=3
-- expect: 3
