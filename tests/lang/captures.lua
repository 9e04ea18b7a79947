-- Inner functions that read and assign variables of the functions around them.
function counter(time)
  local count, sum = 0, 0.0
  local function add(x)
    count = count + 1
    sum = sum + x
  end
  add(time)
  add(time * 2)
  if time > 0 then add(100) end
  return count, sum
end
-- run: counter time=1
-- expect: 3, 103
-- run: counter time=-1
-- expect: 2, -3

function two_levels(p)
  local x = p.x
  local function outer(k)
    local y = k
    local function inner()
      x = x + y
      y = y + 1
    end
    inner()
    inner()
    return y
  end
  local a = outer(1.0)
  local b = outer(p.y)
  return x, a, b
end
-- run: two_levels p=10,5,0
-- expect: 24, 3, 7

function in_loops(frame)
  local total = 0
  for k = 1, 4 do
    local local_to_turn = k
    local function bump() local_to_turn = local_to_turn * 2 total = total + local_to_turn end
    bump()
    if (frame >> k) & 1 == 1 then bump() end
  end
  return total
end
-- run: in_loops frame=0
-- expect: 20
-- run: in_loops frame=-1
-- expect: 60

function parameters_too(time)
  local function double() time = time * 2 end
  double()
  double()
  return time
end
-- run: parameters_too time=3
-- expect: 12
