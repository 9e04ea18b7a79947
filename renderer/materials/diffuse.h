// What diffuse light makes of shading normals that differ from geometric ones, written once for one point and for many:
// normals turned to the viewer, and light that fades towards the geometric horizon.
#pragma once

#include "renderer/lane_math.h"

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

} // namespace moonshade::renderer
