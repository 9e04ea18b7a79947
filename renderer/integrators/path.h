// The state of one path of a wavefront.
#pragma once

#include "renderer/geometry/geometry.h"
#include "renderer/sampling/sampler.h"
#include "renderer/volumes/media.h"

namespace moonshade::renderer {

/// In fours of numbers, which kernels take and give as such.
struct alignas(64) Path {
  Ray ray;
  Vec3 throughput{1};
  float eta2 = 1; ///< by which the throughput was divided at interfaces
  Vec3 from{0};   ///< where the direction was drawn: the origin, but for sheets passed since
  float pdf = 0;  ///< of the direction, by the surface it comes from

  Sampler sampler;
  uint32_t segments = 0; ///< rays so far
  uint32_t bounces = 0;  ///< vertices at which the direction changed
  float width = 0;       ///< of the footprint at the ray's origin
  float spread = 0;      ///< its growth per distance
  float travelled = 0;   ///< from `from` to the origin
  bool mirror = true;    ///< no light sampling could have found what this ray finds
  bool alive = true;
  bool faulted = false;
  uint8_t fill = 0; ///< to a four
  Vec3 radiance{0};
  float fill_radiance = 0;
  Media media{};
};
static_assert(sizeof(Path) == 128);

/// A ray towards a light, and what it brings where nothing is in between.
struct Shadow {
  Ray ray;
  Vec3 contribution{0};
  uint32_t owner = 0;
};
static_assert(sizeof(Shadow) == 48);

/// Numbers drawn at one vertex. Dimension 0 is the place in the pixel, 1 that on the lens.
enum Draw : uint32_t { kLightChoice, kLightPoint, kLobe, kDirection, kRoulette, kOpacity, kDrawCount };
inline constexpr uint32_t kLensDimension = 1;
/// `segments` counts the ray that led to the vertex.
inline uint32_t dimension_of(uint32_t segments, Draw draw) { return 1 + segments * kDrawCount + draw; }

/// The part of the way to a light that a shadow ray goes: it stops short of the light's own surface.
inline constexpr float kShadowReach = 1 - 1e-4f;
/// Where it ends that begins `offset` away from the surface.
inline float shadow_end(float distance, float offset) {
  return distance == kInfinity ? kInfinity : distance * kShadowReach - offset;
}

/// Bounces from which chance ends paths.
inline constexpr uint32_t kRouletteFrom = 5;

} // namespace moonshade::renderer
