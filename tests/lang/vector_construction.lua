-- vec2, vec3, vec4 and rgb string numbers and vectors together; one number counts for every component.
function construct(p, uv, time)
  return vec2(time), vec3(time), vec4(time), vec3(uv, time), vec3(time, uv), vec4(uv, uv), vec4(p, 1), vec4(1, p)
end
-- run: construct p=1,2,3 uv=4,5 time=6
-- expect: 6, 6, 6, 6, 6, 6, 6, 6, 6, 4, 5, 6, 6, 4, 5, 4, 5, 4, 5, 1, 2, 3, 1, 1, 1, 2, 3

function colours(frame) return rgb(0.25, 0.5, 1), vec3(frame, frame * 2, 3), vec2(1, 2) * 0.5 end
-- run: colours frame=7
-- expect: 0.25, 0.5, 1, 7, 14, 3, 0.5, 1
