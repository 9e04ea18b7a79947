// The parts of the program `exhaustive`. Each prints a line for what it has looked at and says whether all bounds hold.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace moonshade::exhaustive {

struct Options {
  std::vector<std::string> names;   ///< what to look at; all where there are none
  uint64_t samples = 1'000'000'000; ///< of pairs and of points of noise
  uint64_t stride = 1;              ///< every how many floats
  unsigned threads = 1;

  bool wants(const std::string& name) const;
};

/// Functions of one number over all floats, and of two over samples, against double.
bool check_floats(const Options& options);
bool check_pairs(const Options& options);
/// Each noise over random points, in both precisions.
bool check_ranges(const Options& options);

/// part(0), part(1), ... on as many threads; returns when all have ended.
void on_threads(unsigned threads, const std::function<void(unsigned)>& part);

} // namespace moonshade::exhaustive
