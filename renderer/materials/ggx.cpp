// Sampling, and the table of single-scattering albedo, made at first use by the same sampling.
#include "renderer/materials/ggx.h"

#include "renderer/sampling/sampler.h"

#include <array>

namespace moonshade::renderer {

Vec3 ggx_sample_visible_normal(const Vec3& v, float alpha, const Vec2& u) {
  Vec3 stretched = glm::normalize(Vec3(alpha * v.x, alpha * v.y, v.z));
  float squared = stretched.x * stretched.x + stretched.y * stretched.y;
  Vec3 t1 = squared > 0 ? Vec3(-stretched.y, stretched.x, 0) / std::sqrt(squared) : Vec3(1, 0, 0);
  Vec3 t2 = glm::cross(stretched, t1);
  float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
  float a = r * std::cos(phi), b = r * std::sin(phi);
  float s = 0.5f * (1 + stretched.z);
  b = (1 - s) * std::sqrt(std::max(0.0f, 1 - a * a)) + s * b;
  Vec3 n = t1 * a + t2 * b + stretched * std::sqrt(std::max(0.0f, 1 - a * a - b * b));
  return glm::normalize(Vec3(alpha * n.x, alpha * n.y, std::max(1e-6f, n.z)));
}

namespace {

constexpr int kSize = 24, kSamples = 256;

/// Over the cosine and over sqrt(alpha), both from 0 to 1.
class AlbedoTable {
public:
  AlbedoTable() {
    for (int i = 0; i < kSize; ++i)
      for (int j = 0; j < kSize; ++j)
        values_[i][j] = measure(std::max(float(i) / (kSize - 1), 1e-3f), float(j * j) / ((kSize - 1) * (kSize - 1)));
  }
  float at(float cosine, float alpha) const {
    float x = std::clamp(cosine, 0.0f, 1.0f) * (kSize - 1);
    float y = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (kSize - 1);
    int i = std::min(int(x), kSize - 2), j = std::min(int(y), kSize - 2);
    float s = x - float(i), t = y - float(j);
    return (values_[i][j] * (1 - s) + values_[i + 1][j] * s) * (1 - t) +
           (values_[i][j + 1] * (1 - s) + values_[i + 1][j + 1] * s) * t;
  }

private:
  /// The mean of G2 / G1 over visible normals.
  static float measure(float cosine, float alpha) {
    alpha = std::max(alpha, 1e-4f);
    Vec3 v(std::sqrt(1 - cosine * cosine), 0, cosine);
    double sum = 0;
    for (uint32_t k = 0; k < kSamples; ++k) {
      Vec2 u((float(k) + 0.5f) / kSamples, unit_float(reverse_bits(k)));
      Vec3 h = ggx_sample_visible_normal(v, alpha, u);
      Vec3 l = h * (2 * glm::dot(v, h)) - v;
      if (l.z <= 0) continue;
      float lambda_v = ggx_lambda(v, alpha);
      sum += (1 + lambda_v) / (1 + lambda_v + ggx_lambda(l, alpha));
    }
    return float(sum / kSamples);
  }
  std::array<std::array<float, kSize>, kSize> values_;
};

} // namespace

float ggx_albedo(float cosine, float alpha) {
  static const AlbedoTable table; // constant once made
  return table.at(cosine, alpha);
}

} // namespace moonshade::renderer
