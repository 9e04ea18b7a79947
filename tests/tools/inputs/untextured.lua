function color(uv) return texture("images/missing.png", uv).rgb end
function emission(uv) return texture("../../lang/images/odd.png", uv).rgb end
function height(uv)
  local a = texture("images/cut.png", uv)
  return texture("textured.lua", uv).x + a.x
end
