#include "renderer/volumes/glow_grid.h"

#include "renderer/volumes/grid.h"

#include <algorithm>

namespace moonshade::renderer {

GlowGrid::GlowGrid(const PlacedObject& placed, const Vec3& low, const Vec3& extent, const int* size,
                   const std::vector<float>& brightness)
    : placed_(placed), low_(low) {
  for (int c = 0; c < 3; ++c) {
    size_[c] = size[c];
    cell_[c] = extent[c] / float(size[c]);
  }
  float cell_volume = cell_.x * cell_.y * cell_.z * std::abs(glm::determinant(placed.linear));
  double sum = 0;
  for (float b : brightness)
    sum += double(b);
  power_ = float(sum) * cell_volume;
  double running = 0;
  for (float b : brightness) {
    cumulative_.push_back(float((running += double(b)) / sum));
    density_.push_back(float(double(b) / (sum * double(cell_volume))));
  }
}

GlowGrid::Point GlowGrid::sample(const Vec2& u, float w) const {
  auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u.x);
  size_t index = size_t(found - cumulative_.begin());
  float below = index ? cumulative_[index - 1] : 0.0f, share = cumulative_[index] - below;
  float within = share > 0 ? std::clamp((u.x - below) / share, 0.0f, 1.0f) : 0.5f;
  Vec3 local = low_ + cell_ * (cell_corner(index, size_) + Vec3(within, u.y, w));
  return {Vec3(placed_.object->to_world * Vec4(local, 1)), density_[index]};
}

/// The integral of density t^2 along the line, cell by cell (Amanatides and Woo 1987).
GlowGrid::Line GlowGrid::line(const Vec3& from, const Vec3& direction) const {
  Vec3 origin = Vec3(placed_.to_object * glm::dvec4(DVec3(from), 1.0)) - low_;
  Vec3 step = Vec3(placed_.to_object * glm::dvec4(DVec3(direction), 0.0));
  float near = 0, far = kInfinity;
  for (int c = 0; c < 3; ++c) {
    float side = cell_[c] * float(size_[c]);
    if (step[c] == 0) {
      if (origin[c] < 0 || origin[c] > side) return {};
      continue;
    }
    float a = -origin[c] / step[c], b = (side - origin[c]) / step[c];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  if (!(near < far)) return {};
  int cell[3], turn[3];
  float next[3], every[3];
  for (int c = 0; c < 3; ++c) {
    float place = (origin[c] + step[c] * near) / cell_[c];
    cell[c] = std::clamp(int(std::floor(place)), 0, size_[c] - 1);
    turn[c] = step[c] > 0 ? 1 : -1;
    next[c] = every[c] = kInfinity;
    if (step[c] == 0) continue;
    next[c] = (cell_[c] * float(cell[c] + (step[c] > 0 ? 1 : 0)) - origin[c]) / step[c];
    every[c] = cell_[c] / std::abs(step[c]);
  }
  float sum = 0, at = near;
  while (at < far) {
    int axis = next[0] <= next[1] && next[0] <= next[2] ? 0 : next[1] <= next[2] ? 1 : 2;
    float end = std::clamp(next[axis], at, far);
    float density = density_[cell_index(cell, size_)];
    sum += density * (end - at) * (end * end + end * at + at * at) / 3;
    at = end;
    next[axis] += every[axis];
    cell[axis] += turn[axis];
    if (cell[axis] < 0 || cell[axis] >= size_[axis]) break;
  }
  return {sum, far};
}

} // namespace moonshade::renderer
