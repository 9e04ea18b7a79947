// Which volumes surround a point.
#pragma once

#include <cstdint>

namespace moonshade::renderer {

/// Volumes that a point is in, by object. Where they overlap, the one that comes last in the scene counts.
struct Media {
  static constexpr uint32_t kNone = UINT32_MAX;
  uint32_t ids[4] = {kNone, kNone, kNone, kNone};

  void cross(uint32_t id, bool entering) {
    for (uint32_t& slot : ids)
      if (slot == id) slot = kNone;
    if (!entering) return;
    for (uint32_t& slot : ids)
      if (slot == kNone) {
        slot = id;
        return;
      }
  }
  uint32_t active() const {
    uint32_t found = kNone;
    for (uint32_t slot : ids)
      if (slot != kNone && (found == kNone || slot > found)) found = slot;
    return found;
  }
};

} // namespace moonshade::renderer
