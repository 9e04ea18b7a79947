-- Functions that give three or four numbers, in f64 on one lane: LLVM returned them in x87 registers and copied them
-- from there to registers for which the instruction does not exist.
local function f0(a1, a2)
  local v3 = 1.5
  return (mat4(v3) - (mat4(3.029) * mat4(v3))), false
end
function probe(p, uv, time, id, backface)
    local v22 = f0(1.5, 1.5)
end
