// Sums of simplex noise over octaves: `fbm`, `turbulence`, `ridged`, `hybrid`, `warp`.
//
// The weights. Octave i = 0, 1, ... sums the noise of p * lacunarity^i. Its weight is
//
//     gain^i * saturate(octaves - i)
//
// so a number of octaves with a fraction has that fraction of the last one, and the sum is continuous in `octaves` (at
// most kMaxOctaves; 0 and less, and NaN, sum nothing). Where the footprint `width` of a pixel (a length in the units of
// p) is above 0, what the pixel sees of the octave is
//
//     seen(i) = smoothstep(0, 1, 2 - 4 width lacunarity^i)
//
// which is 1 while a pixel is at most a quarter of the octave's unit and 0 from half of it on, where its noise would
// alias: the shaped noise n becomes mean + seen (n - mean), so that what is faded out leaves its mean. An octave that
// no lane sees costs nothing.
#pragma once

#include "stdlib/noise.h"

namespace moonshade::stdlib {

/// More octaves than this are not added: the last would be 2^31 times as fine as the first.
inline constexpr int kMaxOctaves = 32;

template <class L> MS_INLINE L scaled(L p, L s) { return p * s; }
template <class L, int N> MS_INLINE Vec<N, L> scaled(Vec<N, L> p, L s) { return p * s; }
template <class P> inline constexpr int noise_dimensions = 1;
template <class L, int N> inline constexpr int noise_dimensions<Vec<N, L>> = N;

template <class I> MS_INLINE int greatest(I x) {
  if constexpr (width_of<I> == 1)
    return x;
  else
    return __builtin_reduce_max(x);
}

/// What the sums share: a footprint of 0 or less (or NaN) is none.
template <class L> struct Octaves {
  L octaves, lacunarity, gain, width;
};

/// One octave of a sum.
template <class L, class P> struct Octave {
  P p;
  L weight, seen;
  Mask<L> counts, filters; ///< filters: the lane has a footprint
  bool any_filters;

  /// f(p), as far as it is seen, and its mean for the rest.
  template <class F> MS_INLINE L see(F f, double mean) const {
    if (!any_filters) return joined(f(p), seen);
    L rest = constant<L>(mean);
    auto visible = less(constant<L>(0), seen);
    L result = joined(rest, p, seen);
    if (any(visible)) {
      L n = f(p);
      result = select(visible, select(filters, mix(rest, n, seen), n), result);
    }
    return result;
  }
};

/// add(octave) for each octave. The loop runs as often as the lane with most octaves needs; lanes for which an octave
/// does not count keep what they have (`counts`).
template <class L, class P, class F> MS_INLINE void each_octave(P p, const Octaves<L>& given, F add) {
  L limit = constant<L>(kMaxOctaves), zero = constant<L>(0), one = constant<L>(1);
  L wanted = select(less(zero, given.octaves), select(less(given.octaves, limit), given.octaves, limit), zero);
  const int count = greatest(convert<Int32<ValueOf<L>>>(ceil(wanted)));
  const auto filters = less(zero, given.width);
  const bool any_filters = any(filters);
  p = joined(p, given.lacunarity);
  L amplitude = joined(one, given.gain), footprint = joined(max(given.width, zero), given.lacunarity);
  for (int i = 0; i < count; ++i) {
    L left = wanted - constant<L>(i), seen = joined(one, footprint);
    if (any_filters) {
      L t = saturate(nmadd(abs(footprint), 4.0, constant<L>(2)));
      seen = select(filters, t * t * madd(t, -2.0, constant<L>(3)), one);
    }
    add(Octave<L, P>{p, amplitude * min(one, left), seen, less(zero, left), filters, any_filters});
    p = scaled(p, given.lacunarity);
    amplitude = amplitude * given.gain;
    footprint = footprint * given.lacunarity;
  }
}

/// A number to begin a sum with.
template <class L, class P> MS_INLINE L beginning(double value, const P& p, const Octaves<L>& given) {
  return joined(constant<L>(value), p, given.octaves, given.lacunarity, given.gain, given.width);
}

/// Means over space of functions of the noise n, by dimensions: abs(n), (1 - abs(n))^2. Measured over 8e6 points.
template <int N> inline constexpr double kMeanMagnitude = N == 1 ? 0.2545 : N == 2 ? 0.4711 : N == 3 ? 0.3139 : 0.1766;
template <int N> inline constexpr double kMeanRidge = N == 1 ? 0.5967 : N == 2 ? 0.3533 : N == 3 ? 0.5261 : 0.7111;

/// sum of weight * shape(noise).
template <class L, class P, class F> MS_INLINE L octave_sum(const P& p, const Octaves<L>& given, double mean, F shape) {
  L sum = beginning(0, p, given);
  each_octave(p, given, [&](const Octave<L, P>& octave) __attribute__((always_inline)) {
    L n = octave.see([&](const P& p) __attribute__((always_inline)) { return shape(noise<L>(p)); }, mean);
    sum = select(octave.counts, madd(n, octave.weight, sum), sum);
  });
  return sum;
}

template <class L, class P>
MS_INLINE L fbm(const P& p, const L& octaves, const L& lacunarity, const L& gain, const L& width) {
  return octave_sum<L>(p, {octaves, lacunarity, gain, width}, 0,
                       [](const L& n) __attribute__((always_inline)) { return n; });
}

/// Perlin's (1985): of the noise's magnitude.
template <class L, class P>
MS_INLINE L turbulence(const P& p, const L& octaves, const L& lacunarity, const L& gain, const L& width) {
  return octave_sum<L>(p, {octaves, lacunarity, gain, width}, kMeanMagnitude<noise_dimensions<P>>,
                       [](const L& n) __attribute__((always_inline)) { return abs(n); });
}

/// Musgrave's ridged multifractal (Ebert et al., "Texturing and Modeling", chapter 16), with offset 1 and gain 2 of its
/// feedback: each octave, the square of 1 - abs(noise), counts where the one before it was high. From 0 to the sum of
/// the weights.
template <class L, class P>
MS_INLINE L ridged(const P& p, const L& octaves, const L& lacunarity, const L& gain, const L& width) {
  const Octaves<L> given = {octaves, lacunarity, gain, width};
  L sum = beginning(0, p, given), before = beginning(1, p, given);
  each_octave(p, given, [&](const Octave<L, P>& octave) __attribute__((always_inline)) {
    const auto ridge = [](const P& p) __attribute__((always_inline)) {
      L n = constant<L>(1) - abs(noise<L>(p));
      return n * n;
    };
    L signal = octave.see(ridge, kMeanRidge<noise_dimensions<P>>) * before;
    sum = select(octave.counts, madd(signal, octave.weight, sum), sum);
    before = select(octave.counts, saturate(signal + signal), before);
  });
  return sum;
}

/// Musgrave's hybrid multifractal (ibidem): each octave of noise + offset counts as much as the sum of products before
/// it, so that valleys are smooth and heights rough.
template <class L, class P>
MS_INLINE L hybrid(const P& p, const L& octaves, const L& lacunarity, const L& gain, const L& width, const L& offset) {
  const Octaves<L> given = {octaves, lacunarity, gain, width};
  L sum = joined(beginning(0, p, given), offset), before = joined(beginning(1, p, given), offset);
  each_octave(p, given, [&](const Octave<L, P>& octave) __attribute__((always_inline)) {
    const auto height = [](const P& p) __attribute__((always_inline)) { return noise<L>(p); };
    L signal = (octave.see(height, 0) + offset) * octave.weight * min(before, constant<L>(1));
    sum = select(octave.counts, sum + signal, sum);
    before = select(octave.counts, signal, before);
  });
  return sum;
}

/// The components of a point that warping moves: all, but of four the first three (the fourth is time).
template <class L> MS_INLINE L moved(const L& p, const Vec<3, L>& way, const L& strength) {
  return madd(way[0], strength, p);
}
template <class L, int N> MS_INLINE Vec<N, L> moved(Vec<N, L> p, const Vec<3, L>& way, const L& strength) {
#pragma clang loop unroll(full)
  for (int i = 0; i < (N < 3 ? N : 3); ++i)
    p[i] = madd(way[i], strength, p[i]);
  return p;
}

/// Domain warping (after Quilez): fbm at a point that has been moved by strength times a vector of three fbm.
template <class L, class P>
MS_INLINE L warp(const P& p, const L& octaves, const L& lacunarity, const L& gain, const L& width, const L& strength) {
  const Octaves<L> given = {octaves, lacunarity, gain, width};
  L zero = beginning(0, p, given);
  Vec<3, L> way = {{zero, zero, zero}};
  each_octave(p, given, [&](const Octave<L, P>& octave) __attribute__((always_inline)) {
    auto visible = octave.counts & less(constant<L>(0), octave.seen);
    if (!any(visible)) return;
    const Vec<3, L> n = vnoise<L>(octave.p);
    L weight = octave.weight * octave.seen;
    way = select<3, L>(visible, madd(n, weight, way), way);
  });
  return fbm<L>(moved(p, way, strength), octaves, lacunarity, gain, width);
}

} // namespace moonshade::stdlib
