-- Captured variables of loops, at several levels, with early returns inside the inner functions.
function walk(p)
  local x, y, moves = 0, 0, 0
  local function move(dx, dy)
    if moves >= 12 then return false end
    x, y = x + dx, y + dy
    moves = moves + 1
    return true
  end
  local function side(n)
    for k = 1, n do
      if not move(1, 0) then return k end
      if p.x * k > 5 then return -k end
    end
    return 0
  end
  local a = side(3)
  local b = 0
  for k = 1, 3 do
    b = b + side(k)
    if not move(0, -k) then break end
  end
  return x, y, moves, a, b
end
-- run: walk p=0,0,0
-- expect: 9, -6, 12, 0, 0
function each_turn_its_own(frame)
  local sum = 0
  for k = 1, 6 do
    local state = k
    local function step(by)
      state = state * 3 + by
      if state > 40 then state = 40 return end
      sum = sum + state
    end
    step(frame & 3)
    step(1)
    if state == 40 then step(-100) end
  end
  return sum
end
