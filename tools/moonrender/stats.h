// --stats: where the time went, as JSON.
#pragma once

#include "tools/moonrender/options.h"

#include <chrono>
#include <string>

namespace moonshade::moonrender {

class Timer {
public:
  double lap() {
    auto now = std::chrono::steady_clock::now();
    double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Can the file that --stats names be written? An error, or empty.
std::string check_stats_place(const Options& options);

/// Writes the file that --stats names, if any; an error, or empty.
std::string write_stats(const Options& options, const renderer::PreparedScene& scene,
                        const renderer::RenderResult& result, double load_seconds);

} // namespace moonshade::moonrender
