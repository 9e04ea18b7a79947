local function late() return require("modules.deep.helpers").gain end
function height(p) return late() * p.x end
-- error: 1:30 module-order
