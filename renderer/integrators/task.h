// A piece of a pass: some pixels, some samples of each; and what a worker counts.
#pragma once

#include <cstdint>
#include <span>

namespace moonshade::renderer {

struct Task {
  /// Pixels of the whole image, as y * width + x.
  std::span<const uint32_t> pixels;
  uint32_t first_sample = 0, samples = 1;
};

struct WorkerStats {
  uint64_t paths = 0, rays = 0, shading_points = 0;
  double trace_seconds = 0;  ///< Embree's queries
  double shade_seconds = 0;  ///< from hit to next ray, shaders included
  double shader_seconds = 0; ///< the part of it within shaders' entries
  double film_seconds = 0;   ///< camera rays and sums
};

} // namespace moonshade::renderer
