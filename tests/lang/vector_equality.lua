-- == and ~= compare all components.
-- mild
function equal(p, n) return p == n, p ~= n, p == p, p.xy == n.xy end
-- run: equal p=1,2,3 n=1,2,3
-- expect: true, false, true, true
-- run: equal p=1,2,3 n=1,2,4
-- expect: false, true, true, true
-- run: equal p=0,-0.0,0 n=-0.0,0,0
-- expect: true, false, true, true
