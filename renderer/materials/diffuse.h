// The diffuse lobe (bsdf.h), written once for one point and for many: Lambert's, fading towards the geometric horizon
// where shading normals differ from geometric ones.
#pragma once

#include "renderer/lane_math.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

/// Chiang et al. 2019: smooth towards the geometric horizon, 1 where both normals agree. `side` and `cosine` are the
/// direction's cosines with the geometric and the shading normal, `between` that of both normals.
template <class L> MS_INLINE L horizon_fade(L side, L cosine, L between) {
  L s = lanes::min(side / (cosine * lanes::max(between, L(1e-4f))), L(1.0f));
  return -s * s * s + s * s + s;
}

/// Below this cosine between both normals, the lobe is scaled by what fading takes on average.
inline constexpr float kNormalsAgree = 0.9999f;

/// The normal, turned just enough for the viewer in direction `out` to see its front; one that equals the geometric
/// normal stays.
template <class L>
MS_INLINE lanes::V3<L> turned_to_viewer(const lanes::V3<L>& normal, const lanes::V3<L>& geometric,
                                        const lanes::V3<L>& out) {
  using namespace lanes;
  L cosine = dot(normal, out), least = min(dot(geometric, out), L(0.02f));
  auto seen = !less(cosine, least);
  if (!any(!seen)) return normal;
  return select<3>(seen, normal, normalize_or(normal + out * (least - cosine), out));
}

/// By how much the footprint's growth per distance grows.
inline constexpr float kDiffuseSpread = 0.3f;

template <class L> struct DiffuseLobe {
  lanes::V3<L> normal, geometric; ///< both to the viewer
  L between;                      ///< cosine of both
  L scale;                        ///< 1 / horizon_albedo(between), or 1

  MS_INLINE lanes::V3<L> folded(const lanes::V3<L>& d) const {
    return d - geometric * (L(2.0f) * lanes::dot(d, geometric));
  }
  /// Density of `sample`.
  MS_INLINE L density(const lanes::V3<L>& in) const {
    L zero = L(0.0f);
    return (lanes::max(lanes::dot(in, normal), zero) + lanes::max(lanes::dot(folded(in), normal), zero)) * L(kInvPi);
  }
  /// Share of the colour that goes from `in` to the viewer, times the cosine; `side` is its cosine with the geometric
  /// normal. 0 where one of the normals does not see it.
  MS_INLINE L share(const lanes::V3<L>& in, L side) const {
    L cosine = lanes::dot(in, normal);
    auto lit = lanes::less(L(0.0f), cosine) & lanes::less(L(0.0f), side);
    L value = L(kInvPi) * cosine * horizon_fade(side, cosine, between) * scale;
    return lanes::select(lit, value, L(0.0f));
  }
  MS_INLINE lanes::V3<L> sample(L u, L v) const {
    lanes::V3<L> local;
    sample_cosine_hemisphere(u, v, local[0], local[1], local[2]);
    lanes::V3<L> d = lanes::Frame<L>(normal).to_world(local);
    auto below = lanes::less(lanes::dot(d, geometric), L(0.0f));
    if (lanes::any(below)) d = lanes::select<3>(below, folded(d), d);
    return lanes::normalize_or(d, geometric);
  }
};

} // namespace moonshade::renderer
