// The tables, by sampling.
#include "renderer/materials/albedo.h"

#include "renderer/materials/diffuse.h"
#include "renderer/materials/ggx.h"
#include "renderer/sampling/sampler.h"

#include <vector>

namespace moonshade::renderer {

namespace {

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

// Samples are taken side by side, as many as any processor's registers hold.
constexpr uint32_t kTogether = 4;
using F = lanes::Wide<float, int(kTogether)>;
using V = lanes::V3<F>;

/// Points of the unit disk, from which visible normals are made.
template <uint32_t samples> struct Disk {
  F a[samples / kTogether], b[samples / kTogether];
  Disk() {
    for (uint32_t k = 0; k < samples; ++k) {
      float x, y;
      sample_disk_by_angle((float(k) + 0.5f) / float(samples), unit_float(reverse_bits(k)), x, y);
      a[k / kTogether][k % kTogether] = x, b[k / kTogether][k % kTogether] = y;
    }
  }
};

/// Facets met from a direction.
struct Facets {
  V v;
  F alpha, lambda;
  V h; ///< their normals
  F c; ///< the normals' cosines with `v`

  Facets(float cosine, float of_alpha)
      : v{{F(std::sqrt(1 - cosine * cosine)), F(0.0f), F(cosine)}}, alpha(of_alpha), lambda(ggx_lambda(v, alpha)) {}
  /// G2 / G1 of what leaves along `l`.
  MS_INLINE F leaving(const V& l) const { return (F(1.0f) + lambda) / (F(1.0f) + lambda + ggx_lambda(l, alpha)); }
  /// Nothing below the surface.
  MS_INLINE F reflected_above() const {
    V l = h * (F(2.0f) * c) - v;
    return lanes::select(lanes::less(F(0.0f), l[2]), leaving(l), F(0.0f));
  }
  MS_INLINE F refracted_below(F eta) const {
    V l = refracted(v, h, c, eta);
    return lanes::select(lanes::less(l[2], F(0.0f)), leaving(l), F(0.0f));
  }
};

/// The mean of what `take` makes of visible normals.
template <uint32_t samples, typename Take> float mean_over_normals(float cosine, float alpha, Take take) {
  static const Disk<samples> disk;
  Facets facets(cosine, alpha);
  double sum = 0;
  for (uint32_t k = 0; k < samples / kTogether; ++k) {
    facets.h = ggx_visible_normal(facets.v, facets.alpha, disk.a[k], disk.b[k]);
    facets.c = lanes::dot(facets.v, facets.h);
    F taken = take(facets);
    for (uint32_t i = 0; i < kTogether; ++i)
      sum += double(taken[i]);
  }
  return float(sum / samples);
}

Table make_facets() {
  Table table;
  add_rows(table, [](float cosine, float alpha) {
    return mean_over_normals<256>(cosine, alpha, [](const Facets& f) { return f.reflected_above(); });
  });
  return table;
}

Table make_coats(const AlbedoTables& tables) {
  Table table;
  for (int k = 0; k < AlbedoTables::kCoats; ++k) {
    float eta = index_at(0, kLargestIndexPlace, k, AlbedoTables::kCoats), f0 = (eta - 1) / (eta + 1);
    add_rows(table, [&](float cosine, float alpha) {
      float once = mean_over_normals<128>(
          cosine, alpha, [&](const Facets& f) { return fresnel_dielectric(f.c, F(eta)) * f.reflected_above(); });
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
      return mean_over_normals<256>(cosine, alpha, [&](const Facets& f) {
        F share = fresnel_dielectric(f.c, F(eta));
        return share * f.reflected_above() + (F(1.0f) - share) * f.refracted_below(F(eta));
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
