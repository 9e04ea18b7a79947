// The one place that knows which Embree is in use: 3 or 4. They differ in the header's folder and in how a query is
// called, and give the same pictures bit for bit (tried over the gallery, 3.13.5 and 4.3.3).
#pragma once

#if MOONSHADE_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace moonshade::renderer {

#if MOONSHADE_EMBREE_MAJOR >= 4

/// How queries are made: for rays that go the same way, or each its own.
class EmbreeQuery {
public:
  explicit EmbreeQuery(bool coherent = false) {
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    if (coherent) intersect_.flags = occluded_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  }

private:
  friend void embree_intersect(RTCScene scene, EmbreeQuery& with, RTCRayHit& hit);
  friend void embree_intersect(RTCScene scene, EmbreeQuery& with, const int* valid, RTCRayHit16& hit);
  friend void embree_occluded(RTCScene scene, EmbreeQuery& with, RTCRay& ray);
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
};

inline void embree_intersect(RTCScene scene, EmbreeQuery& with, RTCRayHit& hit) {
  rtcIntersect1(scene, &hit, &with.intersect_);
}
inline void embree_intersect(RTCScene scene, EmbreeQuery& with, const int* valid, RTCRayHit16& hit) {
  rtcIntersect16(valid, scene, &hit, &with.intersect_);
}
inline void embree_occluded(RTCScene scene, EmbreeQuery& with, RTCRay& ray) {
  rtcOccluded1(scene, &ray, &with.occluded_);
}

#else

/// How queries are made: for rays that go the same way, or each its own.
class EmbreeQuery {
public:
  explicit EmbreeQuery(bool coherent = false) {
    rtcInitIntersectContext(&context_);
    if (coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }

private:
  friend void embree_intersect(RTCScene scene, EmbreeQuery& with, RTCRayHit& hit);
  friend void embree_intersect(RTCScene scene, EmbreeQuery& with, const int* valid, RTCRayHit16& hit);
  friend void embree_occluded(RTCScene scene, EmbreeQuery& with, RTCRay& ray);
  RTCIntersectContext context_;
};

inline void embree_intersect(RTCScene scene, EmbreeQuery& with, RTCRayHit& hit) {
  rtcIntersect1(scene, &with.context_, &hit);
}
inline void embree_intersect(RTCScene scene, EmbreeQuery& with, const int* valid, RTCRayHit16& hit) {
  rtcIntersect16(valid, scene, &with.context_, &hit);
}
inline void embree_occluded(RTCScene scene, EmbreeQuery& with, RTCRay& ray) {
  rtcOccluded1(scene, &with.context_, &ray);
}

#endif

} // namespace moonshade::renderer
