-- Faults at the top level where its parameter is 0.
local parts = param("parts", 0)
local each = 7 // parts

function height(p)
  return p.x * each
end
