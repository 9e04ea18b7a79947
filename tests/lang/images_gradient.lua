-- The derivative of a look-up is that of what it gives: of bilinear interpolation, scaled by the levels.
-- mild
-- near: 0.05
function slope(uv) return gradient(function(q) return texture("images/smooth.png", q, { raw = true }).x end, uv * 0.1) end
function slopes(uv, fw) return fwidth(function(q) return texture("images/smooth.png", q, 0.1).y end, uv * 0.1, fw) end
