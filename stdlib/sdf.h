// Shapes as signed distances: the distance to the surface, negative inside. All are exact and have slope 1 wherever
// they are smooth; union, intersect and subtract bound the distance to what they make from below. NaN gives NaN.
//
// Source: I. Quilez, "Distance functions" and "Smooth minimum" (2008-2013): the quadratic polynomial one.
#pragma once

#include "stdlib/geometry.h"
#include "stdlib/numbers.h"

namespace moonshade::stdlib {

template <class L, int N> MS_INLINE L sd_sphere(Vec<N, L> p, L radius) { return length(p) - radius; }

/// The half extents of the box; its edges are rounded by `round`, within it.
template <class L, int N> MS_INLINE L sd_box(Vec<N, L> p, Vec<N, L> half, L round) {
  L zero = constant<L>(0);
  Vec<N, L> q = map<N, L>([round](L x, L h) __attribute__((always_inline)) { return abs(x) - h + round; }, p, half);
  L greatest = q[0];
#pragma clang loop unroll(full)
  for (int i = 1; i < N; ++i)
    greatest = max(greatest, q[i]);
  Vec<N, L> outside = map<N, L>([zero](L x) __attribute__((always_inline)) { return max(x, zero); }, q);
  return length(outside) + min(greatest, zero) - round;
}

/// About the y axis: `major` from the axis to the tube's middle, `minor` the tube's radius.
template <class L> MS_INLINE L sd_torus(Vec<3, L> p, L major, L minor) {
  L ring = length(Vec<2, L>{{p[0], p[2]}}) - major;
  return length(Vec<2, L>{{ring, p[1]}}) - minor;
}

/// Of a line from a to b; a sphere where they are one point.
template <class L, int N> MS_INLINE L sd_capsule(Vec<N, L> p, Vec<N, L> a, Vec<N, L> b, L radius) {
  Vec<N, L> from = p - a, line = b - a;
  L square = dot(line, line), zero = constant<L>(0);
  L t = select(equal(square, zero), zero, saturate(dot(from, line) / square));
  return length(from - line * t) - radius;
}

/// The half space below a plane with unit normal n, at `offset` from the origin along it.
template <class L, int N> MS_INLINE L sd_plane(Vec<N, L> p, Vec<N, L> n, L offset) { return dot(p, n) - offset; }

// Smooth forms blend where the distances differ by less than `smooth`, and lie at most smooth / 4 beyond the sharp
// ones.
template <class L> MS_INLINE L union_of(L a, L b, L smooth) {
  L near = saturate(constant<L>(1) - abs(a - b) / smooth);
  L sharp = min(a, b);
  return select(less(constant<L>(0), smooth), nmadd(near * near, smooth * constant<L>(0.25), sharp), sharp);
}
template <class L> MS_INLINE L intersect(L a, L b, L smooth) { return -union_of(-a, -b, smooth); }
template <class L> MS_INLINE L subtract(L a, L b, L smooth) { return -union_of(-a, b, smooth); }

} // namespace moonshade::stdlib
