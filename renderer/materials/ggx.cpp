// Sampling, Fresnel, and the tables of albedos, made at first use by the same sampling.
#include "renderer/materials/ggx.h"

#include "renderer/materials/diffuse.h"
#include "renderer/sampling/sampler.h"
#include "renderer/sampling/warp.h"

#include <array>
#include <vector>

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

float fresnel_dielectric(float cosine, float eta) {
  float c = std::clamp(cosine, 0.0f, 1.0f);
  float sine2 = (1 - c * c) / (eta * eta);
  if (sine2 >= 1) return 1;
  float t = std::sqrt(1 - sine2);
  float parallel = (eta * c - t) / (eta * c + t), across = (c - eta * t) / (c + eta * t);
  return 0.5f * (parallel * parallel + across * across);
}

namespace {

constexpr int kCosines = 24, kAlphas = 16, kIndices = 16;

/// The cosine of a row: closer together towards grazing, where albedos change most.
float row_cosine(int i) { return std::max(float(i * i) / ((kCosines - 1) * (kCosines - 1)), 1e-4f); }
float column_alpha(int j) { return std::max(float(j * j) / ((kAlphas - 1) * (kAlphas - 1)), 1e-4f); }

/// A place between two entries.
struct Between {
  int low;
  float share;
  Between(float x, int size) {
    x = std::clamp(x, 0.0f, 1.0f) * float(size - 1);
    low = std::min(int(x), size - 2);
    share = x - float(low);
  }
  template <typename Read> float of(Read read) const { return read(low) * (1 - share) + read(low + 1) * share; }
};

/// Over sqrt(cosine) and sqrt(alpha), both from 0 to 1.
class AlbedoTable {
public:
  template <typename Measure> explicit AlbedoTable(Measure measure) : values_(kCosines * kAlphas) {
    for (int j = 0; j < kAlphas; ++j)
      for (int i = 0; i < kCosines; ++i)
        values_[j * kCosines + i] = measure(row_cosine(i), column_alpha(j));
  }
  const float* row(int j) const { return values_.data() + size_t(j) * kCosines; }
  float at(float cosine, float alpha) const {
    Between x(std::sqrt(std::max(cosine, 0.0f)), kCosines), y(std::sqrt(std::max(alpha, 0.0f)), kAlphas);
    return y.of([&](int j) { return x.of([&](int i) { return values_[j * kCosines + i]; }); });
  }

private:
  std::vector<float> values_;
};

/// -1 to 1 for indices from 0 to infinity, stretched around 1, where grazing reflection changes most.
float index_place(float eta) {
  float x = (eta - 1) / (eta + 1);
  return std::copysign(std::sqrt(std::abs(x)), x);
}
float index_at(float place) {
  float x = place * std::abs(place);
  return (1 + x) / (1 - x);
}

/// Over the index, too.
class IndexTable {
public:
  template <typename Measure> IndexTable(float low, float high, int size, Measure measure) : low_(low), high_(high) {
    for (int k = 0; k < size; ++k) {
      float eta = index_at(low + (high - low) * float(k) / float(size - 1));
      tables_.emplace_back([&](float cosine, float alpha) { return measure(cosine, alpha, eta); });
    }
  }
  Between place(float eta) const { return Between((index_place(eta) - low_) / (high_ - low_), int(tables_.size())); }
  const float* row(int k, int j) const { return tables_[size_t(k)].row(j); }
  float at(float cosine, float alpha, float eta) const {
    return place(eta).of([&](int k) { return tables_[size_t(k)].at(cosine, alpha); });
  }

private:
  float low_, high_;
  std::vector<AlbedoTable> tables_;
};

/// Calls `take(h, cosine with v)` for visible normals and gives the mean of what it returns.
template <typename Take> float mean_over_normals(float cosine, float alpha, uint32_t samples, Take take) {
  Vec3 v(std::sqrt(1 - cosine * cosine), 0, cosine);
  double sum = 0;
  for (uint32_t k = 0; k < samples; ++k) {
    Vec2 u((float(k) + 0.5f) / float(samples), unit_float(reverse_bits(k)));
    Vec3 h = ggx_sample_visible_normal(v, alpha, u);
    sum += take(v, h, glm::dot(v, h));
  }
  return float(sum / samples);
}

/// G2 / G1 of what leaves along `l`; nothing below the surface.
float leaving_above(const Vec3& v, const Vec3& h, float c, float alpha) {
  Vec3 l = h * (2 * c) - v;
  if (l.z <= 0) return 0;
  float lambda_v = ggx_lambda(v, alpha);
  return (1 + lambda_v) / (1 + lambda_v + ggx_lambda(l, alpha));
}

float leaving_below(const Vec3& v, const Vec3& h, float c, float alpha, float eta) {
  Vec3 l = refracted(v, h, c, eta);
  if (l.z >= 0) return 0;
  float lambda_v = ggx_lambda(v, alpha);
  return (1 + lambda_v) / (1 + lambda_v + ggx_lambda(l, alpha));
}

constexpr float kLargestIndex = 0.9905f; // index_place(100), and a little

/// What a coat reflects, and the mean of that over the hemisphere.
struct CoatTables {
  IndexTable albedo{0, kLargestIndex, kIndices, [](float cosine, float alpha, float eta) {
                      float once = mean_over_normals(cosine, alpha, 128, [&](const Vec3& v, const Vec3& h, float c) {
                        return fresnel_dielectric(c, eta) * leaving_above(v, h, c, alpha);
                      });
                      float f0 = (eta - 1) / (eta + 1), all = ggx_albedo(cosine, alpha);
                      return std::min(1.0f, once * (1 + f0 * f0 * (1 - all) / all));
                    }};
  IndexTable mean{0, kLargestIndex, kIndices, [this](float cosine, float alpha, float eta) {
                    if (cosine > row_cosine(1)) return 0.0f; // the mean is the same for all: two rows do
                    double sum = 0;
                    constexpr int kSteps = 64;
                    for (int k = 0; k < kSteps; ++k)
                      sum += albedo.at(std::sqrt((float(k) + 0.5f) / kSteps), alpha, eta);
                    return float(sum / kSteps);
                  }};
};

const CoatTables& coat_tables() {
  static const CoatTables tables; // constant once made
  return tables;
}

} // namespace

Vec3 refracted(const Vec3& v, const Vec3& h, float c, float eta) {
  float sine2 = (1 - c * c) / (eta * eta);
  if (sine2 >= 1) return Vec3(0);
  return h * (c / eta - std::sqrt(1 - sine2)) - v / eta;
}

float ggx_albedo(float cosine, float alpha) {
  static const AlbedoTable table([](float mu, float a) {
    return mean_over_normals(mu, a, 256,
                             [&](const Vec3& v, const Vec3& h, float c) { return leaving_above(v, h, c, a); });
  });
  return table.at(cosine, alpha);
}

CoatAlbedo::CoatAlbedo(float alpha, float ior) {
  const CoatTables& tables = coat_tables();
  Between k = tables.albedo.place(ior), j(std::sqrt(alpha), kAlphas);
  for (int corner = 0; corner < 4; ++corner) {
    rows_[corner] = tables.albedo.row(k.low + corner / 2, j.low + corner % 2);
    shares_[corner] = (corner / 2 ? k.share : 1 - k.share) * (corner % 2 ? j.share : 1 - j.share);
  }
  mean_ = tables.mean.at(0, alpha, ior);
}

float CoatAlbedo::at(float cosine) const {
  Between i(std::sqrt(std::max(cosine, 0.0f)), kCosines);
  float low = 0, high = 0;
  for (int corner = 0; corner < 4; ++corner) {
    low += shares_[corner] * rows_[corner][i.low];
    high += shares_[corner] * rows_[corner][i.low + 1];
  }
  return low * (1 - i.share) + high * i.share;
}

float glass_albedo(float cosine, float alpha, float eta) {
  static const IndexTable table(-kLargestIndex, kLargestIndex, 3 * kIndices, [](float mu, float a, float index) {
    return mean_over_normals(mu, a, 256, [&](const Vec3& v, const Vec3& h, float c) {
      float f = fresnel_dielectric(c, index);
      return f * leaving_above(v, h, c, a) + (f < 1 ? (1 - f) * leaving_below(v, h, c, a, index) : 0.0f);
    });
  });
  return table.at(cosine, alpha, eta);
}

float horizon_albedo(float cosine) {
  constexpr int kSize = 64;
  static const std::array<float, kSize> table = [] {
    std::array<float, kSize> values{};
    for (int i = 0; i < kSize; ++i) {
      float between = std::max(float(i) / (kSize - 1), 1e-3f);
      Vec3 ng(std::sqrt(1 - between * between), 0, between);
      constexpr uint32_t kSamples = 1024;
      double sum = 0;
      for (uint32_t k = 0; k < kSamples; ++k) {
        Vec3 l = sample_cosine_hemisphere({(float(k) + 0.5f) / kSamples, unit_float(reverse_bits(k))});
        float side = glm::dot(l, ng);
        if (side > 0 && l.z > 0) sum += horizon_fade(side, l.z, between);
      }
      values[size_t(i)] = float(sum / kSamples);
    }
    return values;
  }();
  return Between(cosine, kSize).of([&](int i) { return table[size_t(i)]; });
}

} // namespace moonshade::renderer
