function color(p)
  return mixx(p, vec3(nosie(p)), 0.5) + undefined
end
-- error: 2:10 unknown-name
-- error: 2:23 unknown-name
-- error: 2:41 unknown-name
