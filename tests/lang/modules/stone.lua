local helpers = require "modules.deep.helpers"
local rough = param("rough", 2.0, { min = 0, max = 10 })
local layers = { { weight = 1.0, step = 0.25 }, { weight = 0.5, step = 0.5 } }
for _, layer in ipairs(layers) do layer.weight = layer.weight * helpers.gain end

local function bumps(p)
  local sum = 0.0
  for _, layer in ipairs(layers) do sum = sum + layer.weight * helpers.triangle(p.x / layer.step) end
  return sum * rough
end

return { bumps = bumps, table = { 1.0, helpers.gain }, count = helpers.counter() }
