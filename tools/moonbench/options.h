// The command line of moonbench, parsed.
#pragma once

#include "runtime/shader.h"

#include <optional>
#include <string>
#include <vector>

namespace moonshade::moonbench {

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> entries; ///< only these; empty: all
  Precision precision = Precision::F32;
  unsigned width = 0; ///< of the simd rows; 0: the best for this machine
  size_t points = 65536;
  unsigned threads = 1;
  unsigned repetitions = 5;
  std::string plot; ///< SVG file; empty: none
  bool json = false;
  ImageOpener images; ///< of the file at work
  bool compile_times = false;
};

struct ParsedOptions {
  std::optional<Options> options; ///< nothing: end with `exit_status`, all is said
  int exit_status = 0;
};
ParsedOptions parse_options(int argc, char** argv);

/// Prints "moonbench: error: MESSAGE" and gives `status`.
int fail(int status, const std::string& message);

} // namespace moonshade::moonbench
