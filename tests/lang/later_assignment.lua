-- A variable without a value at first, assigned on every path.
function assigned_later(p)
  local x
  if p.x > 0 then x = p.y else x = p.z end
  local a, b
  a = x
  b = a * 2
  return a + b
end
-- run: assigned_later p=1,2,3
-- expect: 6

function in_loop(frame)
  local last
  local k = 0
  repeat
    last = k * k
    k = k + 1
  until k > (frame & 3)
  return last
end
-- run: in_loop frame=3
-- expect: 9

-- A function may be defined later, and in a `do` of its own with what it alone sees.
local hidden
do
  local kept = 7
  function hidden(x) return x + kept end
end
local table_of_block
do
  local base = 2
  table_of_block = { base, base * 2 }
end

function private(time)
  local inner
  do
    local step = time * 2
    do
      local k <const> = 1
      inner = function(x) step = step + k return x + step end
    end
  end
  local sum = 0.0
  for i = 1, 3 do
    local each
    do
      local own = i * 10
      function each() own = own + 1 return own end
    end
    each()
    sum = sum + each()
  end
  local first = inner(1)
  local second = inner(1)
  return hidden(time), first, second, sum, table_of_block[2]
end
-- run: private time=3
-- expect: 10, 8, 9, 66, 4
