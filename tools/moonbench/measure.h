// Measuring one entry of one shader in every mode over the same points, and comparing the results.
#pragma once

#include "runtime/frontend.h"
#include "tools/moonbench/options.h"

#include <string>
#include <vector>

namespace moonshade::moonbench {

struct Row {
  std::string shader, entry, mode;
  unsigned width = 1;
  double mpoints_per_second = 0;
  double ratio_to_lua = 1;
  double compile_ms = 0;         ///< of stock Lua: loading the file
  double max_difference = 0;     ///< from stock Lua, over all components of all points where both are finite
  uint64_t differing_points = 0; ///< points beyond the bound, or that fault in one of the two only
  uint64_t faults = 0;
  bool agrees = true; ///< within what the contract allows
};

struct Measurement {
  std::vector<Row> rows;
  std::string error; ///< empty where all went well
};
Measurement measure(const CheckedShader& shader, size_t entry, const Options& options);

/// Seconds that this thread has computed: what other programs take from it does not count.
double thread_seconds();

} // namespace moonshade::moonbench
