-- annotations state types, and are checked
---@param v vec3
---@return vec3
local function size(v)
  ---@type vec3
  local s = v:length()
  return s
end

---@return vec3
function color(p)
  return vec3(size(p))
end
-- error: 3:12 annotation-mismatch
-- error: 5:12 annotation-mismatch
