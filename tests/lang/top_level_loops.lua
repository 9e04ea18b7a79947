-- The top level runs functions, loops and calls before it is frozen.
local total, product = 0, 1
local function even(k) return k % 2 == 0 end
for k = 1, 6 do
  total = total + k
  if even(k) then product = product * k end
end
local i, found = 0, -1
while true do
  i = i + 1
  if i * i > 200 then found = i break end
end
repeat local done = found > 100 found = found * 2 until done
local direction = normalize(vec3(total, product, found))
local noise_at = perlin(vec3(0.5, 0.25, 0.125))

function values() return total, product, found, noise_at end
-- run: values
-- expect: 21, 48, 240, -0.083585768938064575
