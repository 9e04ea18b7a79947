-- A call in one arm of a varying branch, in a loop, where every lane of the arm has faulted: the loop's other lanes go
-- on. (The steps of `while` are counted; lanes that have faulted leave a loop where steps are counted.)
local function f(a)
  local b = a
  while b < 3.0 do
    b = b + 1.0
  end
  return b
end
function probe(time, id)
  local s = time
  local n = 0
  while n < 5 do
    n = n + 1
    if id == 0 then
      s = s + 1 // id + f(time)
    end
    s = s + 1.0
    if s > 100.0 then return s, n end
  end
  return s, 0
end
