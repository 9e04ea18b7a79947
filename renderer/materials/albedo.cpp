// The tables, by sampling.
#include "renderer/materials/albedo.h"

#include "renderer/materials/diffuse.h"
#include "renderer/materials/ggx.h"
#include "renderer/sampling/sampler.h"

#include <vector>

namespace moonshade::renderer {

namespace {

using V = lanes::V3<float>;
using Table = std::vector<float>;
constexpr int kCosines = AlbedoTables::kCosines, kAlphas = AlbedoTables::kAlphas;

float row_cosine(int i) { return std::max(float(i * i) / ((kCosines - 1) * (kCosines - 1)), 1e-4f); }
float column_alpha(int j) { return std::max(float(j * j) / ((kAlphas - 1) * (kAlphas - 1)), 1e-4f); }
/// index_place's inverse, of entry `k` between two places.
float index_at(float low, float high, int k, int size) {
  float place = low + (high - low) * float(k) / float(size - 1), x = place * std::abs(place);
  return (1 + x) / (1 - x);
}

/// Adds measure(cosine, alpha) of all.
template <typename Measure> void add_rows(Table& table, Measure measure) {
  for (int j = 0; j < kAlphas; ++j)
    for (int i = 0; i < kCosines; ++i)
      table.push_back(measure(row_cosine(i), column_alpha(j)));
}

/// Calls `take(v, h, their cosine)` for visible normals and gives the mean of what it returns.
template <typename Take> float mean_over_normals(float cosine, float alpha, uint32_t samples, Take take) {
  V v = {{std::sqrt(1 - cosine * cosine), 0, cosine}};
  double sum = 0;
  for (uint32_t k = 0; k < samples; ++k) {
    V h = ggx_sample_visible_normal(v, alpha, (float(k) + 0.5f) / float(samples), unit_float(reverse_bits(k)));
    sum += take(v, h, lanes::dot(v, h));
  }
  return float(sum / samples);
}

/// G2 / G1 of what leaves along `l`.
float leaving(const V& v, const V& l, float alpha) {
  float lambda_v = ggx_lambda(v, alpha);
  return (1 + lambda_v) / (1 + lambda_v + ggx_lambda(l, alpha));
}
/// Nothing below the surface.
float leaving_above(const V& v, const V& h, float c, float alpha) {
  V l = h * (2 * c) - v;
  return l[2] > 0 ? leaving(v, l, alpha) : 0;
}
float leaving_below(const V& v, const V& h, float c, float alpha, float eta) {
  V l = refracted(v, h, c, eta);
  return l[2] < 0 ? leaving(v, l, alpha) : 0;
}

Table make_facets() {
  Table table;
  add_rows(table, [](float cosine, float alpha) {
    return mean_over_normals(cosine, alpha, 256,
                             [&](const V& v, const V& h, float c) { return leaving_above(v, h, c, alpha); });
  });
  return table;
}

Table make_coats(const AlbedoTables& tables) {
  Table table;
  for (int k = 0; k < AlbedoTables::kCoats; ++k) {
    float eta = index_at(0, kLargestIndexPlace, k, AlbedoTables::kCoats), f0 = (eta - 1) / (eta + 1);
    add_rows(table, [&](float cosine, float alpha) {
      float once = mean_over_normals(cosine, alpha, 128, [&](const V& v, const V& h, float c) {
        return fresnel_dielectric(c, eta) * leaving_above(v, h, c, alpha);
      });
      float all = facet_albedo(tables, cosine, alpha);
      return std::min(1.0f, once * (1 + f0 * f0 * (1 - all) / all));
    });
  }
  return table;
}

Table make_coat_means(const AlbedoTables& tables) {
  constexpr int kSteps = 64;
  Table table;
  for (int row = 0; row < AlbedoTables::kCoats * kAlphas; ++row) {
    double sum = 0;
    for (int k = 0; k < kSteps; ++k) {
      Between<float> cosine = cosine_place(std::sqrt((float(k) + 0.5f) / kSteps));
      sum += between_pair(tables.coats, row * kCosines + cosine.low, cosine);
    }
    table.push_back(float(sum / kSteps));
  }
  return table;
}

Table make_glasses() {
  Table table;
  for (int k = 0; k < AlbedoTables::kGlasses; ++k) {
    float eta = index_at(-kLargestIndexPlace, kLargestIndexPlace, k, AlbedoTables::kGlasses);
    add_rows(table, [&](float cosine, float alpha) {
      return mean_over_normals(cosine, alpha, 256, [&](const V& v, const V& h, float c) {
        float f = fresnel_dielectric(c, eta);
        return f * leaving_above(v, h, c, alpha) + (f < 1 ? (1 - f) * leaving_below(v, h, c, alpha, eta) : 0.0f);
      });
    });
  }
  return table;
}

Table make_horizons() {
  constexpr uint32_t kSamples = 1024;
  Table table;
  for (int i = 0; i < AlbedoTables::kHorizons; ++i) {
    float between = std::max(float(i) / (AlbedoTables::kHorizons - 1), 1e-3f);
    Vec3 ng(std::sqrt(1 - between * between), 0, between);
    double sum = 0;
    for (uint32_t k = 0; k < kSamples; ++k) {
      Vec3 l = sample_cosine_hemisphere({(float(k) + 0.5f) / kSamples, unit_float(reverse_bits(k))});
      float side = glm::dot(l, ng);
      if (side > 0 && l.z > 0) sum += horizon_fade(side, l.z, between);
    }
    table.push_back(float(sum / kSamples));
  }
  return table;
}

} // namespace

AlbedoTables albedo_tables(AlbedoNeeds needs) {
  AlbedoTables tables;
  static const Table horizons = make_horizons();
  tables.horizons = horizons.data();
  if (needs.facets) {
    static const Table facets = make_facets();
    tables.facets = facets.data();
    static const Table coats = make_coats(tables);
    tables.coats = coats.data();
    static const Table means = make_coat_means(tables);
    tables.coat_means = means.data();
  }
  if (needs.glass) {
    static const Table glasses = make_glasses();
    tables.glasses = glasses.data();
  }
  return tables;
}

} // namespace moonshade::renderer
