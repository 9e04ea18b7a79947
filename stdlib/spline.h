// Splines: between the two middle ones of four values, and through tables of any length (linear, Catmull-Rom, uniform
// cubic B-spline, as RenderMan's `spline`).
//
// A table is given as its length and a function of an index that gives the value there, so that it may lie in memory,
// in registers or in an array of the language, and be of numbers or vectors.
//
// Sources: E. Catmull and R. Rom, "A class of local interpolating splines" (1974); The RenderMan Interface 3.2,
// appendix.
#pragma once

#include "stdlib/numbers.h"
#include "stdlib/vec.h"

namespace moonshade::stdlib {

/// From b at t = 0 to c at t = 1, with slope (c - a)/2 and (d - b)/2 there; goes on as that cubic outside.
template <class L> MS_INLINE L catmullrom(L t, L a, L b, L c, L d) {
  L half = constant<L>(0.5);
  L cubic = (d - a) * half + (b - c) * constant<L>(1.5);
  L square = a - b * constant<L>(2.5) + c * constant<L>(2) - d * half;
  return madd(madd(madd(cubic, t, square), t, (c - a) * half), t, b);
}

/// Twice continuously differentiable from span to span, within the values; does not go through them.
template <class L> MS_INLINE L bspline(L t, L a, L b, L c, L d) {
  L sixth = constant<L>(1.0 / 6), three = constant<L>(3);
  L cubic = ((d - a) + (b - c) * three) * sixth;
  L square = (a + c) * constant<L>(0.5) - b;
  return madd(madd(madd(cubic, t, square), t, (c - a) * constant<L>(0.5)), t, (a + c + b * constant<L>(4)) * sixth);
}

// Tables --------------------------------------------------------------------------------------------------------------

/// Where x of 0..1 lies among `spans` spans: the span's index, an integral number, and the place in it, 0..1. x is
/// clamped; NaN lies in the first span, its place NaN.
template <class L> struct Span {
  L index, place;
};
template <class L> MS_INLINE Span<L> find_span(L x, int spans) {
  L scaled = saturate(x) * constant<L>(spans);
  L index = clamp(floor(scaled), constant<L>(0), constant<L>(spans - 1));
  return {index, scaled - index};
}

// The three over values of one table, numbers or vectors.
template <class L> MS_INLINE L between(L t, L a, L b) { return mix(a, b, t); }
template <class L, int N> MS_INLINE Vec<N, L> between(L t, const Vec<N, L>& a, const Vec<N, L>& b) {
  return map<N, L>([t](L x, L y) __attribute__((always_inline)) { return mix(x, y, t); }, a, b);
}
template <class L, int N>
MS_INLINE Vec<N, L> catmullrom(L t, const Vec<N, L>& a, const Vec<N, L>& b, const Vec<N, L>& c, const Vec<N, L>& d) {
  return map<N, L>([t](L a, L b, L c, L d) __attribute__((always_inline)) { return catmullrom(t, a, b, c, d); }, a, b,
                   c, d);
}
template <class L, int N>
MS_INLINE Vec<N, L> bspline(L t, const Vec<N, L>& a, const Vec<N, L>& b, const Vec<N, L>& c, const Vec<N, L>& d) {
  return map<N, L>([t](L a, L b, L c, L d) __attribute__((always_inline)) { return bspline(t, a, b, c, d); }, a, b, c,
                   d);
}

/// Linear through all of `count` values at equal distances over 0..1; value(index) takes an integral number.
template <class L, class F> MS_INLINE auto table_linear(L x, int count, F value) {
  Span<L> at = find_span(x, count > 1 ? count - 1 : 1);
  return between(at.place, value(at.index), value(min(at.index + constant<L>(1), constant<L>(count - 1))));
}
/// Through the values but the first and the last, which shape the ends, as in RenderMan; at least four of them.
template <class L, class F> MS_INLINE auto table_catmullrom(L x, int count, F value) {
  Span<L> at = find_span(x, count - 3);
  auto of = [&](int i) __attribute__((always_inline)) { return value(at.index + constant<L>(i)); };
  return catmullrom(at.place, of(0), of(1), of(2), of(3));
}
/// Drawn to the values without going through them; at least four.
template <class L, class F> MS_INLINE auto table_bspline(L x, int count, F value) {
  Span<L> at = find_span(x, count - 3);
  auto of = [&](int i) __attribute__((always_inline)) { return value(at.index + constant<L>(i)); };
  return bspline(at.place, of(0), of(1), of(2), of(3));
}

} // namespace moonshade::stdlib
