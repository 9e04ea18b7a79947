-- Top-level variables are computed once and are constants then.
local base = 2
local table_size <const> = base * 8
local tint = vec3(0.25, 0.5, 1) * base
local steps = 0
for k = 1, 10 do
  if k % 3 == 0 then goto continue end
  steps = steps + k
  ::continue::
end
local function square(x) return x * x end
local derived = square(base + 0.5)
offset = -1.5

function constants() return base, table_size, steps, derived, offset end
-- run: constants
-- expect: 2, 16, 37, 6.25, -1.5

function used(p) return p * tint + offset end
-- run: used p=1,1,1
-- expect: -1, -0.5, 0.5

do
  local hidden = square(3.0)
  function from_block(time) return time + hidden end
end
-- run: from_block time=1
-- expect: 10
