-- mandelbrot.lua: iterations until z^2 + c leaves the circle of radius 2, at most 256, as a share of these
function height(p)
  local cx, cy = p.x * 0.3125 - 2, p.y * 0.3125 - 1.25
  local x, y, n = 0.0, 0.0, 0
  while n < 256 and x * x + y * y <= 4 do
    x, y = x * x - y * y + cx, 2 * x * y + cy
    n = n + 1
  end
  return n / 256
end
