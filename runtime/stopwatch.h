// Milliseconds of stages.
#pragma once

#include <chrono>
#include <utility>

namespace moonshade {

class Stopwatch {
public:
  /// Milliseconds since the last call, or since the beginning.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace moonshade
