-- Nothing but its own, whenever it runs.
local sum = 0
local squares = { 0, 0, 0 }
for i = 1, 3 do
  squares[i] = i * i
  sum = sum + squares[i]
end
return { gain = sum / 14, squares = squares }
