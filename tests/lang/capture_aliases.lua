-- One variable reached on several ways: as capture of a function and of those that it calls.
function paths(time)
  local x = time
  local function add(k) x = x + k end
  local function twice(k)
    add(k)
    x = x * 2
    add(k)
    return x
  end
  local function thrice(k)
    local y = twice(k)
    add(y)
    local function inner()
      x = x - 1
      y = y + x
      add(1)
    end
    inner()
    inner()
    return y
  end
  local y = thrice(1)
  return x, y
end
-- run: paths time=1
-- expect: 10, 23
function parameters_as_captures(p)
  local function outer(v, w)
    local function swap() v, w = w, v end
    local function fold()
      swap()
      v = v + w * 0.5
    end
    fold()
    if v.x > 1 then fold() end
    return v, w
  end
  local a, b = outer(p, p.zyx)
  return a - b
end
-- run: parameters_as_captures p=0,1,0
-- expect: 0, 0.5, 0
