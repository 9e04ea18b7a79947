-- Every kind of entry at once, for comparing backends.
local scale = param("scale", 3, { min = 0.1, max = 20 })
local tint = param("tint", rgb(0.8, 0.4, 0.2))

function height(p)
  return 0.05 * turbulence(p * scale, 3)
end

function color(p, n, uv)
  local t = smoothstep(-0.5, 0.5, noise(p * scale * 2))
  return mix(tint, rgb(uv.x, uv.y, 0.5), t) * (0.6 + 0.4 * n.y)
end

function roughness(p)
  return 0.3 + 0.5 * abs(sin(4 * p.x))
end

function metallic(p)
  if p.y > 0.2 then return 1 end
  return 0
end

function reflectance(n, i)
  return 0.3 * (1 - abs(dot(n, i)))
end

function emission(P)
  return rgb(0.02, 0, 0.05) * max(0, P.y)
end
