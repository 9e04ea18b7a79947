// The float arrays of a batch's inputs. The components of a vector follow each other.
#pragma once

#include <cstdint>

namespace moonshade::renderer {

enum Channel : uint8_t {
  kLocal = 0,      // p
  kWorld = 3,      // P
  kNormal = 6,     // n
  kGeometric = 9,  // ng
  kIncident = 12,  // i
  kUv = 15,        // uv
  kDpdu = 17,      // dpdu
  kDpdv = 20,      // dpdv
  kFootprint = 23, // fw
  kTime = 24,      // time
  kChannelCount = 25
};

/// A bit a channel.
constexpr uint32_t channel_mask(Channel first, unsigned components) { return ((1u << components) - 1) << first; }

} // namespace moonshade::renderer
