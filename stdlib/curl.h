// Curl noise (Bridson, Houriham, Nordenstam, "Curl-noise for procedural fluid flow", SIGGRAPH 2007): the curl of a
// potential made of simplex noise, from its exact gradient, so its divergence is 0 but for rounding.
//
// In 2-D (dn/dy, -dn/dx) of n = noise(p); in 3-D the curl of vnoise(p); in 4-D the curl by x, y and z of vnoise(p), the
// fourth coordinate being time. Once continuously differentiable; components within -10..10, of mean 0.
#pragma once

#include "stdlib/noise.h"

namespace moonshade::stdlib {

template <class L> MS_INLINE Vec<2, L> curl(const Vec<2, L>& p) {
  SumWithGradient<L, 2> sum;
  add_noise<L>(p, sum);
  Vec<2, L> g = sum.gradient(kNoiseScale<2>);
  return {{g[1], -g[0]}};
}

template <class L, int N>
  requires(N > 2)
MS_INLINE Vec<3, L> curl(const Vec<N, L>& p) {
  Three<SumWithGradient<L, N>> sum;
  add_noise<L>(p, sum);
  Vec<N, L> a = sum.each[0].gradient(kNoiseScale<N>), b = sum.each[1].gradient(kNoiseScale<N>),
            c = sum.each[2].gradient(kNoiseScale<N>);
  return {{c[1] - b[2], a[2] - c[0], b[0] - a[1]}};
}

} // namespace moonshade::stdlib
