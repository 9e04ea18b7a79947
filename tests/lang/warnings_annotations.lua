-- Annotations of parameters that there are not, and misspelt types, are warnings.
---@param pp vec3
---@param x nubmer
---@return number
local function f(p, x)
  return p.x + x
end

function height(p)
  return f(p, 1)
end
-- run: height p=1,2,3
-- expect: 2
-- warning: 2:11 annotated-parameter
-- warning: 3:13 annotated-type
