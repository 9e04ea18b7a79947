-- Colour, splines and signed distances.
function colors(p, time)
  return luminance(p), srgb2linear(p), linear2srgb(p), hsv2rgb(p), rgb2hsv(p), oklab2rgb(p), rgb2oklab(p),
    blackbody(time * 1000), palette(time, p, p.zyx, vec3(1), vec3(0, 0.33, 0.67))
end

function known(p)
  return luminance(rgb(1, 1, 1)), hsv2rgb(vec3(1 / 3, 1, 1)), rgb2hsv(rgb(0, 0, 0.5)), rgb2hsv(rgb(0.25)),
    srgb2linear(0), linear2srgb(p.x), vec3(0.25, 0, 0):luminance()
end
-- run: known p=0,0,0
-- expect: 1, 0, 1, 0, 0.66666666666666663, 1, 0.5, 0, 0, 0.25, 0, 0, 0.053150000000000003

function splines(p, n, time)
  return catmullrom(time, p.x, p.y, p.z, n.x), bspline(time, p.x, p.y, p.z, n.x), catmullrom(time, p, n, p + 1, n - p),
    bspline(time, p, n, p, n)
end

function ends(p) return catmullrom(0, 1, 2, 5, 9), catmullrom(1, 1, 2, 5, 9), bspline(0, 6, 6, 6, 1), bspline(p.x, 3, 3, 3, 3) end
-- run: ends p=0.5,0,0
-- expect: 2, 5, 6, 3

function shapes(p, n, uv)
  local ball, block = sd_sphere(p, 1), sd_box(p, vec3(1, 0.5, 0.25), 0.1)
  local rod, ring = sd_capsule(p, n, vec3(0.5), 0.3), sd_torus(p, 1, 0.25)
  return ball, block, rod, ring, sd_plane(p, n, 0.5), sd_sphere(uv, 1), sd_box(uv, vec2(1, 2)), sd_capsule(uv, uv.yx, vec2(1), 0.1),
    sd_plane(uv, vec2(0, 1)), union(ball, block), intersect(ball, rod, 0.2), subtract(ball, ring, 0.3)
end

function distances(p)
  return sd_sphere(p, 1), sd_box(p, vec3(1)), sd_box(vec3(0), vec3(1, 2, 3)), sd_capsule(p, vec3(0), vec3(0), 1), p:sd_sphere(2),
    union(1, 2), intersect(1, 2), subtract(1, 2), union(0, 0, 1), intersect(0, 0, 1), union(p, vec3(1, 5, 1))
end
-- run: distances p=3,4,0
-- expect: 4, 3.6055512754639891, -1, 4, 3, 1, 2, 1, -0.25, 0.25, 1, 4, 0
