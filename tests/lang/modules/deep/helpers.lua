-- Its locals are constants once it has run; a global function of a module is one of the shader.
local runs = 0
for i = 1, 4 do runs = runs + i end

function shared(p) return vec3(runs, p.y, 1) end

local function counter()
  local n = runs
  return function() return n + 1 end
end

return {
  gain = 0.5,
  triangle = function(x) return abs(fract(x) - 0.5) end,
  counter = counter,
}
