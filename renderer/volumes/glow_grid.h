// Where in a volume light comes from: the mean emission of the cells of a grid, by which the volume is sampled as a
// light. A point drawn in proportion to emission gives a direction, and all that glows along it counts ("line
// integration", Simon et al. 2017): the density of a direction is that of all points along it, finite however near the
// volume is, and rays that surfaces or collisions send into the volume can be weighed against it.
#pragma once

#include "renderer/geometry/geometry.h"

#include <vector>

namespace moonshade::renderer {

class GlowGrid {
public:
  static constexpr int kCells = 16; ///< along the longest side

  /// `low` and `extent` of the box in object space, `size` cells along each axis; `brightness`: luminance of the mean
  /// emission of each. Some is greater than 0.
  GlowGrid(const PlacedObject& placed, const Vec3& low, const Vec3& extent, const int* size,
           const std::vector<float>& brightness);

  struct Point {
    Vec3 world{0};
    float density = 0; ///< per volume in the world
  };
  Point sample(const Vec2& u, float w) const;

  /// A direction as seen from a point: its density per solid angle, and how far there is anything of the grid. Both 0
  /// where it passes by.
  struct Line {
    float pdf = 0, far = 0;
  };
  Line line(const Vec3& from, const Vec3& direction) const;

  /// Luminance of the emission, over all of the volume in the world.
  float power() const { return power_; }

private:
  const PlacedObject& placed_;
  Vec3 low_, cell_;
  int size_[3];
  std::vector<float> cumulative_, density_; ///< per volume in the world
  float power_ = 0;
};

} // namespace moonshade::renderer
