-- Lua's grammar that the dialect leaves out is no syntax error
function height(p)
  local t <const> = function(...) return select("#", ...) end
  return p.x
end
-- error: 3:30 varargs
-- error: 3:42 varargs
-- error: 3:54 varargs
