// The GGX microfacet distribution (Walter et al. 2007) with Smith's masking (Heitz 2014), in the local frame of the
// shading normal, z up, and Fresnel's equations: written over the lane L, for one point and for many.
#pragma once

#include "renderer/lane_math.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

template <class L> MS_INLINE L square(L x) { return x * x; }

template <class L> MS_INLINE L ggx_density(const lanes::V3<L>& h, stdlib::NonDeduced<L> alpha) {
  L alpha2 = alpha * alpha;
  return alpha2 / (L(kPi) * square(h[0] * h[0] + h[1] * h[1] + h[2] * h[2] * alpha2));
}

/// Smith's Lambda.
template <class L> MS_INLINE L ggx_lambda(const lanes::V3<L>& v, stdlib::NonDeduced<L> alpha) {
  L tan2 = (v[0] * v[0] + v[1] * v[1]) / lanes::max(v[2] * v[2], L(1e-12f));
  return L(0.5f) * (stdlib::sqrt(L(1.0f) + alpha * alpha * tan2) - L(1.0f));
}

/// A normal as seen from `v` (Heitz 2018); `a` and `b` are a point drawn from the unit disk.
template <class L>
MS_INLINE lanes::V3<L> ggx_visible_normal(const lanes::V3<L>& v, stdlib::NonDeduced<L> alpha, stdlib::NonDeduced<L> a,
                                          stdlib::NonDeduced<L> b) {
  using namespace lanes;
  L zero = L(0.0f), one = L(1.0f);
  V3<L> stretched = unit(V3<L>{{alpha * v[0], alpha * v[1], v[2]}});
  L squared = stretched[0] * stretched[0] + stretched[1] * stretched[1];
  auto tilted = less(zero, squared);
  L length = stdlib::sqrt(squared);
  V3<L> t1 = {{select(tilted, -stretched[1] / length, one), select(tilted, stretched[0] / length, zero), zero}};
  V3<L> t2 = cross(stretched, t1);
  L s = L(0.5f) * (one + stretched[2]), left = one - a * a;
  b = (one - s) * stdlib::sqrt(max(left, zero)) + s * b;
  V3<L> n = t1 * a + t2 * b + stretched * stdlib::sqrt(max(left - b * b, zero));
  return unit(V3<L>{{alpha * n[0], alpha * n[1], max(n[2], L(1e-6f))}});
}

/// Share of unpolarised light that an interface reflects, met at this cosine; `eta` is the index beyond it over that
/// before it. 1 where reflection is total.
template <class L> MS_INLINE L fresnel_dielectric(L cosine, stdlib::NonDeduced<L> eta) {
  L one = L(1.0f), c = lanes::clamp(cosine, L(0.0f), one);
  L sine2 = (one - c * c) / (eta * eta);
  L t = stdlib::sqrt(one - sine2);
  L below = eta * c + t, below_across = c + eta * t;
  L parallel = (eta * c - t) * below_across, across = (c - eta * t) * below;
  L f = L(0.5f) * (parallel * parallel + across * across) / square(below * below_across);
  return lanes::select(lanes::less(sine2, one), f, one);
}

/// Where light that leaves along `v` came from through an interface with normal `h`, c = v·h > 0; zero where there is
/// no such direction.
template <class L>
MS_INLINE lanes::V3<L> refracted(const lanes::V3<L>& v, const lanes::V3<L>& h, stdlib::NonDeduced<L> c,
                                 stdlib::NonDeduced<L> eta) {
  L one = L(1.0f), zero = L(0.0f), inverse = one / eta;
  L sine2 = (one - c * c) * (inverse * inverse);
  lanes::V3<L> direction = h * (c * inverse - stdlib::sqrt(one - sine2)) - v * inverse;
  return lanes::select<3>(lanes::less(sine2, one), direction, {{zero, zero, zero}});
}

/// (1 - cosine)^5 (Schlick 1994).
template <class L> MS_INLINE L schlick_power(L cosine) {
  L m = lanes::clamp(L(1.0f) - cosine, L(0.0f), L(1.0f)), m2 = m * m;
  return m2 * m2 * m;
}

} // namespace moonshade::renderer
