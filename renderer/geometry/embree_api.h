// The one place that knows which Embree is in use: 3 or 4. They differ in the header's folder and in how a query is
// called.
#pragma once

#if MOONSHADE_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace moonshade::renderer {

inline void embree_intersect(RTCScene scene, RTCRayHit& hit) {
#if MOONSHADE_EMBREE_MAJOR >= 4
  rtcIntersect1(scene, &hit, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &hit);
#endif
}

inline void embree_occluded(RTCScene scene, RTCRay& ray) {
#if MOONSHADE_EMBREE_MAJOR >= 4
  rtcOccluded1(scene, &ray, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

} // namespace moonshade::renderer
