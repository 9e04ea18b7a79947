// Shaders that do not end: they fault at the step limit, a million steps a point. What is measured before a render
// stops looking at more points after some thousands of these; what was not looked at counts as nothing, as faults do,
// and is met again, point by point, where it is seen.
#pragma once

#include "renderer/materials/material_set.h"

namespace moonshade::renderer {

inline constexpr uint64_t kMostEndless = 4096;

/// How many points of the log ran into the step limit.
inline uint64_t endless_points(const FaultLog& faults) {
  uint64_t count = 0;
  for (const auto& [key, points] : faults)
    if (key.code == uint8_t(FaultCode::StepLimit)) count += points;
  return count;
}

} // namespace moonshade::renderer
