// Photons where they met surfaces, in a tree over their positions. It is built from a list in a fixed order, and looks
// at photons in an order that depends on it and on the place alone: sums have the same bits whoever asks.
#pragma once

#include "renderer/math.h"

#include <vector>

namespace moonshade::renderer {

struct Photon {
  Vec3 position{0};
  Vec3 power{0};   ///< carried, of all photons' share
  Vec3 towards{0}; ///< unit, to where it came from
  Vec3 normal{0};  ///< geometric, on the side it came from
  uint32_t bounces = 0;
};

class PhotonMap {
public:
  PhotonMap() = default;
  PhotonMap(std::vector<Photon> photons, uint32_t emitted, float radius_scale);

  /// Calls visit(photon) for all within `radius` of `at`.
  template <typename Visit> void near(const Vec3& at, float radius, Visit visit) const {
    if (photons_.empty()) return;
    uint32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    float squared = radius * radius;
    while (depth) {
      const Node& node = nodes_[stack[--depth]];
      if (node.axis == kLeaf) {
        for (uint32_t k = node.begin; k < node.end; ++k) {
          Vec3 apart = photons_[k].position - at;
          if (glm::dot(apart, apart) <= squared) visit(photons_[k]);
        }
        continue;
      }
      float side = at[node.axis] - node.split;
      if (side <= radius) stack[depth++] = node.begin; // the lower half
      if (side >= -radius) stack[depth++] = node.end;
    }
  }
  uint32_t emitted() const { return emitted_; }
  size_t size() const { return photons_.size(); }
  /// What first radii are multiplied by in this pass.
  float radius_scale() const { return radius_scale_; }

private:
  static constexpr uint8_t kLeaf = 3;
  struct Node {
    float split = 0;
    uint32_t begin = 0, end = 0; ///< photons of a leaf; or the children's indices
    uint8_t axis = kLeaf;
  };
  uint32_t build(uint32_t begin, uint32_t end);

  std::vector<Photon> photons_;
  std::vector<Node> nodes_;
  uint32_t emitted_ = 0;
  float radius_scale_ = 1;
};

} // namespace moonshade::renderer
