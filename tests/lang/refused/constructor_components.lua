function color(p, uv)
  return vec3(uv) + vec3(1, 2) + vec3(p, 1) + vec3(true)
end
-- error: 2:10 constructor-components
-- error: 2:21 constructor-components
-- error: 2:34 constructor-components
-- error: 2:52 argument-type
