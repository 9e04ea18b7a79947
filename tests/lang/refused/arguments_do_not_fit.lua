function color(p, uv)
  return mix(p, vec3(uv, 0), uv) + max(p, uv).x
end
-- error: 2:10 arguments-do-not-fit
-- error: 2:36 arguments-do-not-fit
