function height(p, uv)
  return p[4] + p[0] + uv[3]
end
-- error: 2:12 component-outside
-- error: 2:19 component-outside
-- error: 2:27 component-outside
