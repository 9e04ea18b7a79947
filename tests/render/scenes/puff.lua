-- A cloud that glows at its core.
function density(p)
  return 12 * max(0, 0.8 - length(p) + 0.4 * fbm(p * 3, 3))
end
function color(p) return rgb(0.95, 0.9, 0.8) end
function emission(p) return rgb(4, 1, 0.2) * max(0, 0.3 - length(p)) end
function anisotropy() return 0.4 end
