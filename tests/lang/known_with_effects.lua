-- What is known while compiling (functions, strings, lengths, fields of a library's table) may be written as a call that
-- assigns or faults.
local kind = param("kind", "wood")

local function make(a)
  return function(b)
    return function(c) return a * 100 + b * 10 + c end
  end
end
function made_at_once(time) return make(time)(2)(3), (make(time)(1))(2) end
-- run: made_at_once time=4
-- expect: 423, 412

function counted(time)
  local n = 0
  local function count(x)
    n = n + 1
    return x
  end
  local same = count("a") == "a"
  local float = math.type(count(2.5)) == "float"
  local wood = count(kind) == "wood"
  local length = #count("abc")
  local pi = count(math).pi
  local sine = count(math).sin(time)
  local cosine = count(cos)(time)
  local field = count({ f = function(x) return x + n end }).f(time)
  if count("b") ~= "b" then n = 100 end
  return n, same, float, wood, length, pi > 3, sine, cosine, field
end
-- run: counted time=0
-- expect: 9, true, true, true, 3, true, 0, 1, 8

local function checked(x, time)
  assert(time > 0)
  return x
end
function text(time) return checked("x", time) == "x" end
function called(time) return checked(sin, time)(0.5) end
function constructed(time) return checked(vec3, time)(0.5) end
function parameter(time) return "wood" ~= checked(kind, time) end
function library(time) return checked(math, time).huge end
function length(time) return #checked("xyz", time) end
function kinds(frame, id) return math.type(frame // id) == "integer", #{ frame % id, 2 } end
-- run: kinds frame=1 id=0
-- expect: fault: division
function element(frame)
  local t = { 1, 2, 3 }
  return math.type(t[frame]) == "integer"
end
-- run: element frame=4
-- expect: fault: index
function raised(time)
  checked(error, time)("always")
  return 1
end
