// From the unit square to directions and points.
#pragma once

#include "renderer/math.h"

namespace moonshade::renderer {

/// Shirley and Chiu's concentric map.
inline Vec2 sample_disk(const Vec2& u) {
  float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return Vec2(0);
  float r, phi;
  if (std::abs(a) > std::abs(b))
    r = a, phi = kPi / 4 * (b / a);
  else
    r = b, phi = kPi / 2 - kPi / 4 * (a / b);
  return r * Vec2(std::cos(phi), std::sin(phi));
}

/// Around +z, density cos / pi.
inline Vec3 sample_cosine_hemisphere(const Vec2& u) {
  Vec2 d = sample_disk(u);
  return {d.x, d.y, std::sqrt(std::max(0.0f, 1 - d.x * d.x - d.y * d.y))};
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
inline float sample_tent(float u) { return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

/// Veach's power heuristic for one sample of each of two strategies.
inline float power_heuristic(float a, float b) {
  if (a == kInfinity) return 1;
  return a * a / (a * a + b * b);
}

} // namespace moonshade::renderer
