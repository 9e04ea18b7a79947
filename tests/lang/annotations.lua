-- Annotations that fit: every form is read.
-- no warnings
---@param v vec3?  the vector
---@param k integer|number
---@return number size, vec3 v  # both
local function both(v, k)
  ---@type number
  local s = v:length() * k
  return s, v
end

---A height.
---@param p vec3
---@return number
function height(p)
  local s, v = both(p, 2)
  return s + v.x + both(p, 0.5)
end
-- run: height p=3,4,0
-- expect: 15.5
