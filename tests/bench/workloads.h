// The workloads of the suite: entries of the shaders in shaders/bench/, and the points that all implementations see.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace moonshade::bench {

struct Workload {
  const char* id;     ///< also the hand-written kernels' name
  const char* shader; ///< file in shaders/bench/
  const char* entry;
  const char* title;
  unsigned outputs;
  /// From stock Lua's, results may differ by more than `tolerance` max(1, |x|) at this share of the points: edges fall
  /// on either side, and what is chaotic differs altogether.
  double tolerance;
  double share = 1e-3;
};

inline constexpr Workload kWorkloads[] = {
    {"W1", "noise.lua", "height", "simplex noise", 1, 1e-4},
    {"W2", "marble.lua", "color", "marble, simplex", 3, 1e-4},
    {"W3a", "perlin.lua", "height", "Perlin noise", 1, 1e-4},
    {"W3b", "marble_perlin.lua", "color", "marble, Perlin", 3, 1e-4},
    {"W4", "planet.lua", "color", "planet, Perlin", 3, 1e-4},
    {"W5", "mandelbrot.lua", "height", "Mandelbrot", 1, 1e-4, 5e-3},
    {"W6", "worley.lua", "height", "Worley F1", 1, 1e-4},
    {"W7", "brick.lua", "color", "brick", 3, 1e-4},
    {"W8fd", "bump.lua", "differences", "bump by differences", 3, 1e-2},
    {"W8ad", "bump.lua", "slope", "bump, exact", 3, 1e-3},
    {"height", "bump.lua", "height", "the bump's height", 1, 1e-4},
};

/// Points of a row-major grid over (8u, 8v, 0.37), in batches of which the results stay in the cache.
struct Grid {
  static constexpr size_t width = 1024, height = 64, count = width * height, batch = 4096;
  std::array<std::vector<float>, 3> p;

  Grid() {
    for (std::vector<float>& axis : p)
      axis.resize(count);
    for (size_t i = 0; i < count; ++i) {
      p[0][i] = static_cast<float>(8 * (static_cast<double>(i % width) + 0.5) / width);
      p[1][i] = static_cast<float>(8 * (static_cast<double>(i / width) + 0.5) / height);
      p[2][i] = 0.37F;
    }
  }
};

} // namespace moonshade::bench
