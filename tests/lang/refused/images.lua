local name = "images/colours.png"
local options = { raw = true }
local scale = param("scale", 1.0)
function height(p, uv) return texture(name, p).x end
function f(p) return texture(3, p.xy).x end
function g(uv) return texture("images/colours.png").x end
function h(uv) return texture("images/colours.png", uv, uv).x end
function k(uv) return texture("images/colours.png", uv, 0, options).x end
function l(uv) return texture("images/colours.png", uv, { wrap = true }).x end
function m(uv) return texture("images/colours.png", uv, { raw = 1 }).x end
function n(uv) return texture("images/colours.png", uv, 0, 1, 2).x end
function o(uv) return texture(scale, uv).x end
function q(uv) return texture("images/" .. name, uv).x end
function r(uv) return texture("images/colours.png", uv, options).x end
function s(uv) return gradient(function(a) return gradient(function(b) return texture(name, b).x end, a).x end, uv) end
-- error: 4:45 argument-type
-- error: 5:30 argument-type
-- error: 6:23 missing-argument
-- error: 7:57 argument-type
-- error: 8:60 image-options
-- error: 9:59 image-options
-- error: 10:65 image-options
-- error: 11:63 too-many-arguments
-- error: 12:31 argument-type
-- error: 13:31 string-building
-- error: 14:57 image-options
-- error: 15:23 gradient-order
