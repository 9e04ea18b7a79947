local file = param("file", "images/colours.png", { doc = "an image" })
function color(uv, fw) return texture(file, uv, fw).rgb end
function mask(uv) return texture("images/odd.png", uv, { raw = true }).w end
