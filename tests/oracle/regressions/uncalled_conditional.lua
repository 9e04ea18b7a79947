-- A function that nothing calls has parameters of no known type: which form `and ... or` has is not known either.
local q = param("q", 0.75)
function probe(p, uv, time, id, backface)
  local function g(a)
    return clamp((id / (-2.554)), (false and a or a), (backface and q or 3.619))
  end
  return p.x
end
