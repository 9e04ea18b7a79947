function height(p) return p.y end
