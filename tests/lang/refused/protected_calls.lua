local function f() return 1 end
function height(p)
  local ok = pcall(f)
  return p.x
end
-- error: 3:14 protected-calls
