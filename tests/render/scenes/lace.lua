-- Glass with holes, its roughness and tint by shader.
function opacity(p) return smoothstep(-0.2, 0.2, sin(p.x * 12) * sin(p.y * 12)) end
function transmission(p) return 0.8 end
function roughness(p) return 0.1 + 0.3 * saturate(p.y) end
function color(p) return rgb(0.9, 0.95, 1) end
function height(p) return 0.01 * noise(p * 6) end
