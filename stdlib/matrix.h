// Square matrices of 3 and 4 columns, in memory column by column.
//
// Sources: the inverses are the adjugates over the determinant (by cross products, and by the six minors of two rows);
// rotation is Rodrigues' formula. All are polynomials and quotients of their arguments, so smooth where they are
// finite; NaN and infinity go through them as through arithmetic.
#pragma once

#include "stdlib/dual.h"
#include "stdlib/geometry.h"
#include "stdlib/numbers.h"

namespace moonshade::stdlib {

template <int N, class L> struct Mat {
  Vec<N, L> c[N];

  /// Not trivial, for the reason of Vec's.
  MS_INLINE constexpr ~Mat() {}

  MS_INLINE const Vec<N, L>& operator[](int i) const { return c[i]; }
  MS_INLINE Vec<N, L>& operator[](int i) { return c[i]; }
};

/// The matrix whose columns are f of the columns of `m`.
template <class L, int N, class T, class F> MS_INLINE Mat<N, L> map_columns(F f, const Mat<N, T>& m) {
  return [&]<size_t... I>(std::index_sequence<I...>)
             __attribute__((always_inline)) { return Mat<N, L>{{f(m[int(I)])...}}; }(std::make_index_sequence<N>());
}

/// The matrix of element(row, column).
template <class L, int N, class F> MS_INLINE Mat<N, L> matrix_of(F element) {
  return [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    auto column = [&](int j) __attribute__((always_inline)) { return Vec<N, L>{{element(int(I), j)...}}; };
    return Mat<N, L>{{column(int(I))...}};
  }(std::make_index_sequence<N>());
}

// m * v and m * n: the columns of m weighted by the components of v, from the first on.
template <class L, int N> MS_INLINE Vec<N, L> multiply(Mat<N, L> m, Vec<N, L> v) {
  Vec<N, L> sum = m[0] * v[0];
#pragma clang loop unroll(full)
  for (int i = 1; i < N; ++i)
    sum = madd(m[i], v[i], sum);
  return sum;
}
template <class L, int N> MS_INLINE Mat<N, L> multiply(Mat<N, L> m, Mat<N, L> n) {
  return map_columns<L>([&](const Vec<N, L>& column) __attribute__((always_inline)) { return multiply<L>(m, column); },
                        n);
}

template <class L, int N> MS_INLINE Mat<N, L> transpose(Mat<N, L> m) {
  return matrix_of<L, N>([&](int row, int column) __attribute__((always_inline)) { return m[row][column]; });
}

/// Of the first two rows, or the last two, of columns i and j: m[row][i] m[row + 1][j] - m[row + 1][i] m[row][j].
template <class L> MS_INLINE L minor_of(const Mat<4, L>& m, int row, int i, int j) {
  return nmadd(m[i][row + 1], m[j][row], m[i][row] * m[j][row + 1]);
}
/// The six minors of two rows, in the order of columns 01, 02, 03, 12, 13, 23.
template <class L> struct Minors {
  L of[6];
  MS_INLINE constexpr ~Minors() {}
};
template <class L> MS_INLINE Minors<L> minors(const Mat<4, L>& m, int row) {
  return {{minor_of(m, row, 0, 1), minor_of(m, row, 0, 2), minor_of(m, row, 0, 3), minor_of(m, row, 1, 2),
           minor_of(m, row, 1, 3), minor_of(m, row, 2, 3)}};
}
template <class L> MS_INLINE L determinant_of(const Minors<L>& s, const Minors<L>& c) {
  L sum = s.of[0] * c.of[5];
  sum = nmadd(s.of[1], c.of[4], sum);
  sum = madd(s.of[2], c.of[3], sum);
  sum = madd(s.of[3], c.of[2], sum);
  sum = nmadd(s.of[4], c.of[1], sum);
  return madd(s.of[5], c.of[0], sum);
}

template <class L> MS_INLINE L determinant(Mat<3, L> m) { return dot(m[0], cross(m[1], m[2])); }
template <class L> MS_INLINE L determinant(Mat<4, L> m) { return determinant_of(minors(m, 0), minors(m, 2)); }

/// Infinite or NaN where the determinant is 0.
template <class L> MS_INLINE Mat<3, L> inverse(Mat<3, L> m) {
  Vec<3, L> r0 = cross(m[1], m[2]), r1 = cross(m[2], m[0]), r2 = cross(m[0], m[1]);
  L scale = constant<L>(1) / dot(m[0], r0);
  return transpose<L>(Mat<3, L>{{r0 * scale, r1 * scale, r2 * scale}});
}
template <class L> MS_INLINE Mat<4, L> inverse(Mat<4, L> m) {
  Minors<L> upper = minors(m, 0), lower = minors(m, 2);
  L scale = constant<L>(1) / determinant_of(upper, lower);
  // Entry (row, column) of the adjugate: the row's column of m is left out, so three columns a < b < c stay, and of the
  // column's pair of rows the other row, `r`. kMinor names the minors of (b, c), (a, c) and (a, b).
  constexpr int kLeft[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
  constexpr int kMinor[4][3] = {{5, 4, 3}, {5, 2, 1}, {4, 2, 0}, {3, 1, 0}};
  return matrix_of<L, 4>([&](int row, int column) __attribute__((always_inline)) {
    const Minors<L>& pair = column < 2 ? lower : upper;
    const int r = column ^ 1;
    const int* left = kLeft[row];
    const int* minor = kMinor[row];
    L sum = m[left[0]][r] * pair.of[minor[0]];
    sum = nmadd(m[left[1]][r], pair.of[minor[1]], sum);
    sum = madd(m[left[2]][r], pair.of[minor[2]], sum);
    return ((row + column) % 2 == 0 ? sum : -sum) * scale;
  });
}
// Rotation by an angle in radians, counter-clockwise: of the plane; about an axis, which need not have length 1, seen
// against it. The zero axis leaves nothing but the cosine.
template <class L> MS_INLINE Vec<2, L> rotate(Vec<2, L> v, L angle) {
  L s = sin(angle), c = cos(angle);
  return {{nmadd(v[1], s, v[0] * c), madd(v[0], s, v[1] * c)}};
}
template <class L> MS_INLINE Vec<3, L> rotate(Vec<3, L> v, Vec<3, L> axis, L angle) {
  L s = sin(angle), c = cos(angle);
  Vec<3, L> k = normalize(axis);
  return madd(k, dot(k, v) * (constant<L>(1) - c), madd(cross(k, v), s, v * c));
}
/// The matrix of the same.
template <class L> MS_INLINE Mat<3, L> rotate(Vec<3, L> axis, L angle) {
  L s = sin(angle), c = cos(angle);
  Vec<3, L> k = normalize(axis), t = k * (constant<L>(1) - c), w = k * s;
  return {{{{madd(k[0], t[0], c), madd(k[0], t[1], w[2]), k[0] * t[2] - w[1]}},
           {{k[1] * t[0] - w[2], madd(k[1], t[1], c), madd(k[1], t[2], w[0])}},
           {{madd(k[2], t[0], w[1]), k[2] * t[1] - w[0], madd(k[2], t[2], c)}}}};
}

} // namespace moonshade::stdlib
