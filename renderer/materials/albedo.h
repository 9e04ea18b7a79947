// How much light one bounce off microfacets sends on, from tables that are made at first use by sampling them
// (ggx.h); looked up for one point or for many.
#pragma once

#include "renderer/lane_math.h"

namespace moonshade::renderer {

/// What a surface has, or may have.
struct SurfaceKinds {
  bool metal, coat, glass, rough, thin;
};

/// What surfaces ask for; the greater tables take a while to make.
struct AlbedoNeeds {
  bool facets = false; ///< of metals, sheets and coats
  bool glass = false;  ///< solid and rough
};
inline AlbedoNeeds albedo_needs(const SurfaceKinds& s) {
  return {s.coat || (s.rough && (s.metal || (s.glass && s.thin))), s.rough && s.glass && !s.thin};
}

/// As plain data. Those over cosines have kCosines of them for each alpha, and kAlphas such rows for each index.
struct AlbedoTables {
  static constexpr int kCosines = 24, kAlphas = 16, kCoats = 16, kGlasses = 48, kHorizons = 64;
  const float* facets = nullptr;
  const float* coats = nullptr;
  const float* coat_means = nullptr; ///< by alpha and index
  const float* glasses = nullptr;
  const float* horizons = nullptr; ///< by the cosine of both normals
};

/// Constant once made.
AlbedoTables albedo_tables(AlbedoNeeds needs);

/// A place between two entries of `size`, of x from 0 to 1.
template <class L> struct Between {
  lanes::Int32<L> low{};
  L share{};

  Between() = default;
  MS_INLINE Between(L x, int size) {
    // What is not a number becomes 0: lanes that are not asked for hold anything.
    L place = lanes::min(lanes::max(L(0.0f), x), L(1.0f)) * L(float(size - 1));
    low = lanes::convert<lanes::Int32<L>>(lanes::min(place, L(float(size - 2))));
    share = place - lanes::convert<L>(low);
  }
  MS_INLINE L of(L at_low, L at_high) const { return at_low * (L(1.0f) - share) + at_high * share; }
};

/// An entry and the one behind it.
template <class L> struct EntryPair {
  L first, second;
};
template <class L> MS_INLINE EntryPair<L> pair_at(const float* table, lanes::Int32<L> index) {
  if constexpr (stdlib::width_of<L> == 1) {
    return {table[index], table[index + 1]};
  } else {
    static_assert(stdlib::width_of<L> == 16);
    auto two = [&](int i) __attribute__((always_inline)) {
      lanes::Wide<float, 2> pair;
      __builtin_memcpy(&pair, table + index[i], sizeof pair);
      return pair;
    };
    auto four = [&](int i)
                    __attribute__((always_inline)) { return __builtin_shufflevector(two(i), two(i + 1), 0, 1, 2, 3); };
    auto eight = [&](int i) __attribute__((always_inline)) {
      return __builtin_shufflevector(four(i), four(i + 2), 0, 1, 2, 3, 4, 5, 6, 7);
    };
    auto sixteen = [&](int i) __attribute__((always_inline)) {
      return L(__builtin_shufflevector(eight(i), eight(i + 4), 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    };
    L low = sixteen(0), high = sixteen(8);
    return {__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30),
            __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31)};
  }
}
template <class L> MS_INLINE L between_pair(const float* table, lanes::Int32<L> entry, const Between<L>& at) {
  EntryPair<L> pair = pair_at<L>(table, entry);
  return at.of(pair.first, pair.second);
}

/// Cosines and alphas lie closer together towards 0, where albedos change most.
template <class L> MS_INLINE Between<L> cosine_place(L cosine) {
  return {stdlib::sqrt(lanes::max(cosine, L(0.0f))), AlbedoTables::kCosines};
}
template <class L> MS_INLINE Between<L> alpha_place(L alpha) {
  return {stdlib::sqrt(lanes::max(alpha, L(0.0f))), AlbedoTables::kAlphas};
}

inline constexpr float kLargestIndexPlace = 0.9905f; // index_place(100), and a little
/// -1 to 1 for indices from 0 to infinity, stretched around 1, where grazing reflection changes most.
template <class L> MS_INLINE L index_place(L eta) {
  L x = (eta - L(1.0f)) / (eta + L(1.0f));
  return stdlib::copy_sign(stdlib::sqrt(stdlib::abs(x)), x);
}
template <class L> MS_INLINE Between<L> coat_place(L ior) {
  return {index_place(ior) * L(1 / kLargestIndexPlace), AlbedoTables::kCoats};
}
template <class L> MS_INLINE Between<L> glass_place(L eta) {
  return {(index_place(eta) + L(kLargestIndexPlace)) * L(0.5f / kLargestIndexPlace), AlbedoTables::kGlasses};
}

/// Of a row and the next; `entry` is the place in the first.
template <class L>
MS_INLINE L albedo_at(const float* table, lanes::Int32<L> entry, const Between<L>& cosine, const Between<L>& alpha) {
  return alpha.of(between_pair(table, entry, cosine), between_pair(table + AlbedoTables::kCosines, entry, cosine));
}
/// The same between two indices.
template <class L>
MS_INLINE L albedo_at(const float* table, lanes::Int32<L> entry, const Between<L>& cosine, const Between<L>& alpha,
                      const Between<L>& index) {
  constexpr int kTable = AlbedoTables::kAlphas * AlbedoTables::kCosines;
  return index.of(albedo_at(table, entry, cosine, alpha), albedo_at(table + kTable, entry, cosine, alpha));
}

/// Share of light from the direction with this cosine that leaves again after one bounce off perfect microfacets; the
/// rest, which bounces more than once, is given back by scaling the lobe (Turquin 2019, "Practical multiple scattering
/// compensation for microfacet models").
template <class L> MS_INLINE L facet_albedo(const AlbedoTables& tables, L cosine, stdlib::NonDeduced<L> alpha) {
  using I = lanes::Int32<L>;
  Between<L> i = cosine_place(cosine), j = alpha_place<L>(alpha);
  return albedo_at(tables.facets, I(j.low * I(AlbedoTables::kCosines) + i.low), i, j);
}

/// Share that facets of a dielectric send on in one bounce, reflected and refracted together; `eta` is the index
/// beyond them over that before them.
template <class L>
MS_INLINE L glass_albedo(const AlbedoTables& tables, L cosine, stdlib::NonDeduced<L> alpha, stdlib::NonDeduced<L> eta) {
  using I = lanes::Int32<L>;
  Between<L> i = cosine_place(cosine), j = alpha_place<L>(alpha), k = glass_place<L>(eta);
  I row = k.low * I(AlbedoTables::kAlphas) + j.low;
  return albedo_at(tables.glasses, I(row * I(AlbedoTables::kCosines) + i.low), i, j, k);
}

/// Share that facets of a dielectric seen from outside reflect, scaled as above: what a coat of this roughness and
/// index (at least 1) reflects.
template <class L> struct CoatAlbedo {
  const float* table = nullptr;
  lanes::Int32<L> row{};
  Between<L> alpha, index;
  L mean{}; ///< over the hemisphere, weighted by the cosine

  CoatAlbedo() = default;
  MS_INLINE CoatAlbedo(const AlbedoTables& tables, L alpha_of_facets, L ior)
      : table(tables.coats), alpha(alpha_place(lanes::max(alpha_of_facets, L(1e-4f)))), index(coat_place(ior)) {
    using I = lanes::Int32<L>;
    row = index.low * I(AlbedoTables::kAlphas) + alpha.low;
    mean = index.of(between_pair(tables.coat_means, row, alpha),
                    between_pair(tables.coat_means + AlbedoTables::kAlphas, row, alpha));
  }
  MS_INLINE L at(L cosine) const {
    using I = lanes::Int32<L>;
    Between<L> i = cosine_place(cosine);
    return albedo_at(table, I(row * I(AlbedoTables::kCosines) + i.low), i, alpha, index);
  }
};

/// By how much light towards a shading normal with this cosine to the geometric one is dimmed on average where it fades
/// towards the horizon (diffuse.h).
template <class L> MS_INLINE L horizon_albedo(const AlbedoTables& tables, L between) {
  Between<L> at(between, AlbedoTables::kHorizons);
  return between_pair(tables.horizons, at.low, at);
}

} // namespace moonshade::renderer
