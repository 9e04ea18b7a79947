-- Operands that do not fit, columns that are none, assignment in place, a matrix from an entry.
function height(p) local m = mat3(p, p, p) + p return 1 end
function f(p) return mat3(p, p, p)[4] end
function g(p) return p * mat3(1) end
function h(p) local m = mat3(1) m[1] = p return p end
function k(p) return mat3(1) * vec4(p, 1) end
function l(p) return mat3(p, p) end
function m(p) return mat3(1) end
function o(p) return mat3(1).x end
function q(p) return mat3(1) / mat3(2) end
-- error: 2:30 operands-do-not-fit
-- error: 3:36 component-outside
-- error: 4:22 operands-do-not-fit
-- error: 5:33 vector-component
-- error: 6:22 operands-do-not-fit
-- error: 7:22 constructor-components
-- error: 8:22 entry-result
-- error: 9:30 unknown-field
-- error: 10:22 operands-do-not-fit
