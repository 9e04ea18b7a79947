// A piece of a pass: some pixels, some samples of each; and what a worker counts.
#pragma once

#include "renderer/math.h"

#include <cstdint>
#include <span>

namespace moonshade::renderer {

/// Pixels that belong together wherever they are rendered: squares of this side, on a grid over the whole image.
inline constexpr int kGroupSide = 4;

struct Task {
  /// Pixels of the whole image, as y * width + x, group by group.
  std::span<const uint32_t> pixels;
  std::span<const uint8_t> groups; ///< sizes, which make up the pixels
  uint32_t first_sample = 0, samples = 1;
  // Where the integrator asks for them.
  const class PhotonMap* photons = nullptr; ///< of this pass
  const class IrradianceCache* cache = nullptr;
};

/// What a camera ray meets first; the default is the surroundings. (Through opaque surfaces only: glass is met, too.)
struct FirstHit {
  /// Depth of the surroundings: a number that tools can still calculate with.
  static constexpr float kNoDepth = 1e10f;

  Vec3 albedo{0};                    ///< share of light that the surface sends on, whatever the way
  Vec3 normal{0};                    ///< bumped, world space, to the viewer
  Vec3 position{0};                  ///< world space
  float depth = kNoDepth;            ///< along the camera's axis
  uint32_t object = 0, material = 0; ///< numbers from 1; 0: none
};

/// Where a task's results go, in the order of its pixels and samples.
struct SampleOutputs {
  Vec3* radiance = nullptr;
  uint8_t* faulted = nullptr; ///< 1: the sample met a fault; null: not asked for
  FirstHit* first = nullptr;  ///< null: not asked for
};

struct WorkerStats {
  uint64_t paths = 0, rays = 0, shading_points = 0;
  double trace_seconds = 0;  ///< Embree's queries
  double shade_seconds = 0;  ///< from hit to next ray, shaders included
  double shader_seconds = 0; ///< the part of it within shaders' entries
  double film_seconds = 0;   ///< camera rays and sums

  WorkerStats& operator+=(const WorkerStats& other) {
    paths += other.paths, rays += other.rays, shading_points += other.shading_points;
    trace_seconds += other.trace_seconds, shade_seconds += other.shade_seconds;
    shader_seconds += other.shader_seconds, film_seconds += other.film_seconds;
    return *this;
  }
};

} // namespace moonshade::renderer
