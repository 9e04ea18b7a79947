// Sums of simplex noise over octaves.
#pragma once

#include "stdlib/noise.h"

namespace moonshade::stdlib {

/// More octaves than this are not added: the last would be 2^31 times as fine as the first.
inline constexpr int kMaxOctaves = 32;

template <class L> MS_INLINE L scaled(L p, L s) { return p * s; }
template <class L, int N> MS_INLINE Vec<N, L> scaled(Vec<N, L> p, L s) { return p * s; }

template <class I> MS_INLINE int greatest(I x) {
  if constexpr (width_of<I> == 1)
    return x;
  else
    return __builtin_reduce_max(x);
}

/// sum over i < octaves of shape(noise(p lacunarity^i)) gain^i. A number of octaves with a fraction counts upwards.
/// The loop runs as often as the lane with most octaves needs; the others leave their sums alone.
template <class L, class P, class F> MS_INLINE L octave_sum(P p, L octaves, L lacunarity, L gain, F shape) {
  L limit = constant<L>(kMaxOctaves), zero = constant<L>(0);
  L wanted = select(less(zero, octaves), select(less(octaves, limit), octaves, limit), zero);
  int count = greatest(convert<Int32<L>>(ceil(wanted)));
  p = joined(p, lacunarity);
  L amplitude = joined(constant<L>(1), gain), sum = joined(zero, p, amplitude);
  for (int i = 0; i < count; ++i) {
    L next = madd(shape(noise<L>(p)), amplitude, sum);
    sum = select(less(constant<L>(i), wanted), next, sum);
    p = scaled(p, lacunarity);
    amplitude = amplitude * gain;
  }
  return sum;
}

template <class L, class P> MS_INLINE L fbm(P p, L octaves, L lacunarity, L gain) {
  return octave_sum(p, octaves, lacunarity, gain, [](L n) __attribute__((always_inline)) { return n; });
}

/// Perlin's: of the noise's magnitude.
template <class L, class P> MS_INLINE L turbulence(P p, L octaves, L lacunarity, L gain) {
  return octave_sum(p, octaves, lacunarity, gain, [](L n) __attribute__((always_inline)) { return abs(n); });
}

} // namespace moonshade::stdlib
