// The GGX microfacet distribution (Walter et al. 2007) with Smith's masking (Heitz 2014), in the local frame of the
// shading normal, z up; Fresnel's equations; and tables of how much light one bounce off such facets sends on.
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

/// Share of unpolarised light that an interface reflects, met at this cosine; `eta` is the index beyond it over that
/// before it. 1 where reflection is total.
float fresnel_dielectric(float cosine, float eta);

/// Where light that leaves along `v` came from through an interface with normal `h`, c = v·h > 0; zero where there is
/// no such direction.
Vec3 refracted(const Vec3& v, const Vec3& h, float c, float eta);

/// (1 - cosine)^5 (Schlick 1994).
inline float schlick_power(float cosine) {
  float m = std::clamp(1 - cosine, 0.0f, 1.0f), m2 = m * m;
  return m2 * m2 * m;
}

/// Share of light from the direction with this cosine that leaves again after one bounce off perfect microfacets; the
/// rest, which bounces more than once, is given back by scaling the lobe (Turquin 2019, "Practical multiple scattering
/// compensation for microfacet models").
float ggx_albedo(float cosine, float alpha);

/// The same off facets of a dielectric seen from outside, with that scaling: what a coat of this roughness and index
/// (at least 1) reflects.
class CoatAlbedo {
public:
  CoatAlbedo() = default;
  CoatAlbedo(float alpha, float ior);
  float at(float cosine) const;
  /// Over the hemisphere, weighted by the cosine.
  float mean() const { return mean_; }

private:
  const float* rows_[4] = {};
  float shares_[4] = {}, mean_ = 0;
};

/// Share that facets of a dielectric send on in one bounce, reflected and refracted together; `eta` as above.
float glass_albedo(float cosine, float alpha, float eta);

/// By how much light towards a shading normal with this cosine to the geometric one is dimmed on average where it fades
/// towards the horizon (bsdf.cpp).
float horizon_albedo(float cosine);

} // namespace moonshade::renderer
