-- Locals and functions that nothing reads. Parameters and loops' variables may stay unused, and so may names with '_'.
local top = 3
local _kept = 4
local function never() return 1 end
local function helper(p, _unused) return p.x end
local table_like = function(x) return x end

function height(p, time)
  local a, b = p.x, p.y
  local assigned
  assigned = a
  local counted = 0
  counted = counted + 1
  local _, z = p.x, p.z
  for i = 1, 3 do
    local inner = 2
  end
  local captured = 1
  local function use() return captured end
  local shadowed = z
  do
    local shadowed = shadowed
  end
  return helper(p, time) + use()
end
-- run: height p=1,2,3 time=0
-- expect: 2
-- warning: 2:7 unused-local
-- warning: 4:16 unused-function
-- warning: 6:7 unused-function
-- warning: 9:12 unused-local
-- warning: 10:9 unused-local
-- warning: 16:11 unused-local
-- warning: 22:11 unused-local
