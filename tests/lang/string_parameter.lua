-- A string parameter is compared with constants at run time, wherever its value is named.
local mode = param("mode", "warm", { choices = { "warm", "cold", "odd" } })
local free = param("free", "")
local top = mode == "cold" and 100 or 0
also = mode

local function is(name, p)
  if name == "warm" then return p.x end
  return -p.x
end

function height(p)
  local m = mode
  if m == "warm" then
    return top + is(mode, p)
  elseif "cold" == also and free ~= "loud" then
    return top + p.y
  end
  return is(also, p) + (free == "loud" and 7 or 0)
end

function unlike(p)
  return (mode ~= "warm") == (p.x > 0), not (mode == "never")
end
-- run: height p=1,2,3
-- expect: 1
-- run: height p=1,2,3 -D mode=cold
-- expect: 102
-- run: height p=1,2,3 -D mode=cold -D free=loud
-- expect: 6
-- run: height p=1,2,3 -D mode=odd
-- expect: -1
-- run: unlike p=1,2,3 -D mode=cold
-- expect: true, true
-- run: unlike p=1,2,3
-- expect: false, true
