// Functions of vectors in 2, 3 and 4 dimensions.
#pragma once

#include "stdlib/vec.h"

namespace moonshade::stdlib {

template <class L, int N> MS_INLINE L dot(Vec<N, L> a, Vec<N, L> b) {
  L sum = a[0] * b[0];
#pragma clang loop unroll(full)
  for (int i = 1; i < N; ++i)
    sum = madd(a[i], b[i], sum);
  return sum;
}

template <class L> MS_INLINE Vec<3, L> cross(Vec<3, L> a, Vec<3, L> b) {
  return {{nmadd(a[2], b[1], a[1] * b[2]), nmadd(a[0], b[2], a[2] * b[0]), nmadd(a[1], b[0], a[0] * b[1])}};
}

template <class L, int N> MS_INLINE L length(Vec<N, L> v) { return sqrt(dot(v, v)); }
template <class L, int N> MS_INLINE L distance(Vec<N, L> a, Vec<N, L> b) { return length(a - b); }

/// The zero vector where the length is zero.
template <class L, int N> MS_INLINE Vec<N, L> normalize(Vec<N, L> v) {
  L size = length(v), zero = constant<L>(0);
  return v * select(equal(size, zero), zero, constant<L>(1) / size);
}

/// i - 2 (n.i) n: i mirrored at the plane of the unit normal n.
template <class L, int N> MS_INLINE Vec<N, L> reflect(Vec<N, L> i, Vec<N, L> n) {
  return madd(n, constant<L>(-2) * dot(n, i), i);
}

/// Snell's law for the unit directions i and n; eta = index before / index behind; 0 at total reflection.
template <class L, int N> MS_INLINE Vec<N, L> refract(Vec<N, L> i, Vec<N, L> n, L eta) {
  L cosine = dot(n, i), zero = constant<L>(0);
  L k = nmadd(eta * eta, nmadd(cosine, cosine, constant<L>(1)), constant<L>(1));
  Vec<N, L> bent = madd(n, -madd(eta, cosine, sqrt(k)), i * eta);
  return select<N, L>(less(k, zero), n * zero, bent);
}

/// n, turned so that it faces against i as g does.
template <class L, int N> MS_INLINE Vec<N, L> faceforward(Vec<N, L> n, Vec<N, L> i, Vec<N, L> g) {
  return select<N, L>(less(dot(g, i), constant<L>(0)), n, -n);
}

} // namespace moonshade::stdlib
