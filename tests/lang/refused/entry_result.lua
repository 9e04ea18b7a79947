function color(p) return p.x end
function height(p) return p end
function roughness(p) return true end
function metallic(p) return p.x, p.y end
function reflectance(uv) return uv end
-- error: 1:26 entry-result
-- error: 2:27 entry-result
-- error: 3:30 entry-result
-- error: 4:34 entry-result
-- error: 5:33 entry-result
