-- Patterns: stock Lua and every variant agree; values, cells and distances that can be told by hand.
function flat(p, uv, fw)
  local t, id, edge = tiles(uv, fw)
  local b, brick_id, brick_edge = brick(uv * 3, fw, 0.1, 0.05, p.x > 0 and 0.5 or 2)
  local d, dot_id, dot_edge = dots(uv * 4, fw)
  return checker(uv, fw), checker(p, fw), stripes(p.x, fw, 0.3), t, id, edge, b, brick_id, brick_edge, d, dot_id, dot_edge
end

function cells(p, uv, fw)
  local h, hexagon_id, hexagon_edge = hexagons(uv * 5, fw, 0.1, 0.1)
  local v, id, edge = voronoi(uv * 5, fw)
  local w, solid_id, solid_edge = voronoi(p, fw, 0.1, 0.8)
  return h, hexagon_id, hexagon_edge, v, id, edge, w, solid_id, solid_edge
end

function solid(p, fw) return wood(p, fw), marble(p, fw), wood(p, 0, 0, 0), marble(p, fw, 0) end

function known(p, uv)
  local t, _, tile_edge = tiles(uv)
  local b, _, brick_edge = brick(uv)
  local d, _, dot_edge = dots(uv)
  local h, _, hexagon_edge = hexagons(vec2(0.5, 0))
  return checker(uv), checker(uv + 1), checker(p), stripes(uv.x), t, tile_edge, b, brick_edge, d, dot_edge, h, hexagon_edge
end
-- run: known p=0.5,1.5,0.5 uv=0.5,0.5
-- expect: 0, 0, 1, 0, 1, 0.47499999999999998, 1, 0.45000000000000001, 1, 0.29999999999999999, 0, -0.025000000000000001

function bonds(uv, time)
  local stacked, raking = brick(uv, 0, 0.1, 0, 0), brick(uv, 0, 0.1, 0, 1 / 3)
  return stacked, raking, brick(uv, time, 0.1, 0.1, 1), brick(uv, time, 0.1, 0.1, 2, 3)
end

function wide(uv)
  local s, t, b = stripes(uv.x, 1e9, 0.25), (tiles(uv, 1e9, 0.5)), brick(uv, 1e9, 0.5, 0, 0.5, 2)
  return checker(uv, 1e9), round(vec3(s, t, b) * 1e9) / 1e9, (dots(uv, 1e9, 0))
end
-- run: wide uv=0.2,0.3
-- expect: 0.5, 0.25, 0.25, 0.375, 0
