#include "renderer/integrators/photon_map.h"

namespace moonshade::renderer {

static constexpr uint32_t kLeafSize = 8;

PhotonMap::PhotonMap(std::vector<Photon> photons, uint32_t emitted, float radius_scale)
    : photons_(std::move(photons)), emitted_(emitted), radius_scale_(radius_scale) {
  if (photons_.empty()) return;
  nodes_.reserve(2 * photons_.size() / kLeafSize + 1);
  build(0, uint32_t(photons_.size()));
}

/// Halves, across the longest side of the box around them.
uint32_t PhotonMap::build(uint32_t begin, uint32_t end) {
  uint32_t index = uint32_t(nodes_.size());
  nodes_.push_back({0, begin, end, kLeaf});
  if (end - begin <= kLeafSize) return index;
  Box box;
  for (uint32_t k = begin; k < end; ++k)
    box.add(photons_[k].position);
  Vec3 size = box.high - box.low;
  uint8_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(photons_.begin() + begin, photons_.begin() + middle, photons_.begin() + end,
                   [axis](const Photon& a, const Photon& b) { return a.position[axis] < b.position[axis]; });
  float split = photons_[middle].position[axis];
  uint32_t low = build(begin, middle), high = build(middle, end);
  nodes_[index] = {split, low, high, axis};
  return index;
}

} // namespace moonshade::renderer
