-- Surroundings with a sun.
function environment(i)
  local sky = mix(rgb(0.9, 0.5, 0.3), rgb(0.1, 0.2, 0.5), saturate(i.y))
  return sky + rgb(40, 35, 30) * smoothstep(0.99, 0.995, dot(i, normalize(vec3(1, 1, 1))))
end
