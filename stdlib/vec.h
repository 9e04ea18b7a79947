// Vectors of N lanes, and what is done with them component by component.
#pragma once

#include "stdlib/lane.h"

#include <utility>

namespace moonshade::stdlib {

template <int N, class L> struct Vec {
  L c[N];

  /// Not trivial, so that calls pass vectors by reference: calling conventions would pack components of small ones into
  /// registers, and the packing would stay in the bitcode.
  MS_INLINE constexpr ~Vec() {}

  MS_INLINE const L& operator[](int i) const { return c[i]; }
  MS_INLINE L& operator[](int i) { return c[i]; }
};

/// f of each component of the vectors (or of the numbers, which count for each component).
template <int N, class L> MS_INLINE L component(const Vec<N, L>& v, int i) { return v.c[i]; }
template <class L> MS_INLINE L component(L x, int) { return x; }

template <int N, class L, class F, class... A> MS_INLINE Vec<N, L> map(F f, const A&... arguments) {
  return [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    auto at = [&](int i) __attribute__((always_inline)) { return f(component(arguments, i)...); };
    return Vec<N, L>{{at(int(I))...}};
  }(std::make_index_sequence<N>());
}

template <int N, class L> MS_INLINE Vec<N, L> operator+(const Vec<N, L>& a, const Vec<N, L>& b) {
  return map<N, L>([](L x, L y) __attribute__((always_inline)) { return x + y; }, a, b);
}
template <int N, class L> MS_INLINE Vec<N, L> operator-(const Vec<N, L>& a, const Vec<N, L>& b) {
  return map<N, L>([](L x, L y) __attribute__((always_inline)) { return x - y; }, a, b);
}
template <int N, class L> MS_INLINE Vec<N, L> operator-(const Vec<N, L>& a) {
  return map<N, L>([](L x) __attribute__((always_inline)) { return -x; }, a);
}
template <int N, class L> MS_INLINE Vec<N, L> operator*(const Vec<N, L>& a, L s) {
  return map<N, L>([s](L x) __attribute__((always_inline)) { return x * s; }, a);
}
/// a*s + b by component.
template <int N, class L> MS_INLINE Vec<N, L> madd(const Vec<N, L>& a, L s, const Vec<N, L>& b) {
  return map<N, L>([s](L x, L y) __attribute__((always_inline)) { return madd(x, s, y); }, a, b);
}
template <int N, class L> MS_INLINE Vec<N, L> select(Mask<L> mask, const Vec<N, L>& a, const Vec<N, L>& b) {
  return map<N, L>([mask](L x, L y) __attribute__((always_inline)) { return select(mask, x, y); }, a, b);
}

} // namespace moonshade::stdlib
