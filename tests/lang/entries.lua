-- The table's entry points with their results, and every input.
function color(p, P, n, ng, i) return p + P + n + ng + i end
-- run: color p=1,1,1 P=2,2,2 n=3,3,3 ng=4,4,4 i=5,5,5
-- expect: 15, 15, 15
function height(p) return p.x end
function reflectance(uv) return uv.x end
function roughness(time, fw) return time + fw end
function metallic(frame) return frame end
function transmission(id) return id end
function opacity(backface) return backface and 1 or 0 end
-- run: opacity backface=true
-- expect: 1
function ior() return 1.5 end
-- run: ior
-- expect: 1.5
function emission(dpdu, dpdv) return cross(dpdu, dpdv) end
-- run: emission dpdu=1,0,0 dpdv=0,1,0
-- expect: 0, 0, 1
function density(p) return -p.y end
function environment(i) return i * 0.5 end
