// From the unit square to directions and points; what hot loops draw is written over the lane L.
#pragma once

#include "renderer/math.h"
#include "stdlib/lane.h"

namespace moonshade::renderer {

/// Sine and cosine of |x| <= pi/4, within 1e-7 (polynomials of Cephes' sinf and cosf).
template <class L> MS_INLINE void sine_and_cosine(L x, L& sine, L& cosine) {
  L z = x * x;
  sine = x + x * z * (L(-1.6666654611e-1f) + z * (L(8.3321608736e-3f) + z * L(-1.9515295891e-4f)));
  cosine = L(1.0f) - z * L(0.5f) +
           z * z * (L(4.166664568298827e-2f) + z * (L(-1.388731625493765e-3f) + z * L(2.443315711809948e-5f)));
}
/// Those of a full turn times `u` in [0, 1].
template <class L> MS_INLINE void sine_and_cosine_of_turns(L u, L& sine, L& cosine) {
  L quarters = u * L(4.0f), k = stdlib::floor(quarters + L(0.5f));
  L s, c;
  sine_and_cosine((quarters - k) * L(kPi / 2), s, c);
  auto q = stdlib::convert<stdlib::Int32<L>>(k);
  using I = decltype(q);
  auto swapped = stdlib::to_mask<L>((q & I(1)) != I(0));
  auto sine_down = stdlib::to_mask<L>((q & I(2)) != I(0)),
       cosine_down = stdlib::to_mask<L>(((q + I(1)) & I(2)) != I(0));
  L a = stdlib::select(swapped, c, s), b = stdlib::select(swapped, s, c);
  sine = stdlib::select(sine_down, -a, a);
  cosine = stdlib::select(cosine_down, -b, b);
}

/// Of the unit disk by angle and radius, the angle in turns.
template <class L> MS_INLINE void sample_disk_by_angle(L ux, L uy, L& x, L& y) {
  L r = stdlib::sqrt(ux);
  sine_and_cosine_of_turns(uy, y, x);
  x = r * x, y = r * y;
}

/// Shirley and Chiu's concentric map.
template <class L> MS_INLINE void sample_disk(L ux, L uy, L& x, L& y) {
  L a = ux * L(2.0f) - L(1.0f), b = uy * L(2.0f) - L(1.0f);
  auto flat = stdlib::less(stdlib::abs(b), stdlib::abs(a));
  L r = stdlib::select(flat, a, b), other = stdlib::select(flat, b, a);
  L ratio = stdlib::select(stdlib::equal(r, L(0.0f)), L(0.0f), other / r);
  L s, c;
  sine_and_cosine(ratio * L(kPi / 4), s, c); // of the angle from the nearer axis
  x = r * stdlib::select(flat, c, s);
  y = r * stdlib::select(flat, s, c);
}
inline Vec2 sample_disk(const Vec2& u) {
  Vec2 p;
  sample_disk(u.x, u.y, p.x, p.y);
  return p;
}

/// Around +z, density cos / pi.
template <class L> MS_INLINE void sample_cosine_hemisphere(L ux, L uy, L& x, L& y, L& z) {
  sample_disk(ux, uy, x, y);
  z = stdlib::sqrt(stdlib::max(L(1.0f) - x * x - y * y, L(0.0f)));
}
inline Vec3 sample_cosine_hemisphere(const Vec2& u) {
  Vec3 d;
  sample_cosine_hemisphere(u.x, u.y, d.x, d.y, d.z);
  return d;
}

/// Around +z within the cone of this `one_minus_cos`, density 1 / (2 pi one_minus_cos).
inline Vec3 sample_cone(const Vec2& u, float one_minus_cos) {
  float z = 1 - u.x * one_minus_cos;
  float r = std::sqrt(std::max(0.0f, 1 - z * z));
  float phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Henyey and Greenstein 1941: density per solid angle of scattering by an angle of this cosine.
inline float phase_hg(float cosine, float g) {
  float base = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * kPi * base * std::sqrt(base));
}
/// The cosine of a scattering angle with that density.
inline float sample_hg(float u, float g) {
  if (std::abs(g) < 1e-3f) return 1 - 2 * u;
  float s = (1 - g * g) / (1 + g - 2 * g * u);
  return std::clamp((1 + g * g - s * s) / (2 * g), -1.0f, 1.0f);
}

/// Offset within a tent of radius 1: the pixel filter, importance-sampled.
template <class L> MS_INLINE L sample_tent(L u) {
  auto left = stdlib::less(u, L(0.5f));
  L root = stdlib::sqrt(stdlib::select(left, L(2.0f) * u, L(2.0f) - L(2.0f) * u));
  return stdlib::select(left, root - L(1.0f), L(1.0f) - root);
}

/// Veach's power heuristic for one sample of each of two strategies.
template <class L> MS_INLINE L power_heuristic(L a, stdlib::NonDeduced<L> b) {
  return stdlib::select(stdlib::equal(a, stdlib::infinity<L>()), L(1.0f), a * a / (a * a + b * b));
}

} // namespace moonshade::renderer
