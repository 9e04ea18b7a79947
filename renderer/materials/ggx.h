// The GGX microfacet distribution (Walter et al. 2007) with Smith's masking (Heitz 2014), in the local frame of the
// shading normal, z up; and how much of the light a rough mirror of it sends back in one bounce.
#pragma once

#include "renderer/math.h"

namespace moonshade::renderer {

inline float ggx_density(const Vec3& h, float alpha) {
  float x = h.x / alpha, y = h.y / alpha;
  float t = x * x + y * y + h.z * h.z;
  return 1 / (kPi * alpha * alpha * t * t);
}

/// Smith's Lambda.
inline float ggx_lambda(const Vec3& v, float alpha) {
  float tan2 = (v.x * v.x + v.y * v.y) / std::max(v.z * v.z, 1e-12f);
  return 0.5f * (std::sqrt(1 + alpha * alpha * tan2) - 1);
}

/// A normal as seen from `v` (Heitz 2018).
Vec3 ggx_sample_visible_normal(const Vec3& v, float alpha, const Vec2& u);

/// Share of light from the direction with this cosine that leaves again after one bounce off perfect microfacets; the
/// rest, which bounces more than once, is given back by scaling the lobe (Turquin 2019, "Practical multiple scattering
/// compensation for microfacet models").
float ggx_albedo(float cosine, float alpha);

} // namespace moonshade::renderer
