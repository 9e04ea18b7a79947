-- A comparison with what is none of a parameter's choices.
local mode = param("mode", "warm", { choices = { "warm", "cold" } })
local free = param("free", "any")

function height(p)
  if mode == "wram" then return 1 end
  if "cold" == mode then return 2 end
  if free == "thing" then return 3 end
  return p.x
end
-- run: height p=5,2,3
-- expect: 5
-- warning: 6:14 unknown-choice
