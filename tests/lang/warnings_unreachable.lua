-- Statements that nothing reaches.
local function after_error(x)
  if x > 100 then
    error("far")
    return 1
  end
  return 2
end

local function endless(x)
  while true do
    x = x + 1
    if x > 10 then return x end
  end
  x = 3
end

local function both(x)
  if x > 0 then
    return 1
  else
    do return 2 end
  end
  local y = x
  return y
end

local function left(x)
  while true do
    x = x + 1
    if x > 10 then break end
  end
  for i = 1, 3 do
    if i == 2 then goto continue end
    x = x + i
    ::continue::
  end
  while true do
    if x > 5 then goto out end
    x = x + 1
  end
  ::out::
  return x
end

function height(p)
  for i = 1, 3 do
    break
    p = p + i
  end
  return after_error(p.x) + endless(p.x) + both(p.x) + left(p.x)
end
-- run: height p=1,2,3
-- expect: 29
-- warning: 5:5 unreachable-code
-- warning: 15:3 unreachable-code
-- warning: 24:3 unreachable-code
-- warning: 49:5 unreachable-code
