// What the comments of a test program say (README.md).
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace moonshade::lang_test {

struct Run {
  unsigned line = 0;
  std::string entry;
  std::vector<std::pair<std::string, std::string>> inputs;
  std::vector<std::pair<std::string, std::string>> parameters; ///< of -D
  std::vector<std::string> expected;                           ///< exactly one
};

struct ExpectedError {
  std::string place; ///< "3:7"
  std::string code;
  bool operator==(const ExpectedError&) const = default;
};

struct Directives {
  std::vector<Run> runs;
  std::vector<ExpectedError> errors;
  std::vector<ExpectedError> warnings;
  bool no_warnings = false;
  bool mild = false;
  double near = 0; ///< how far compiled code may be from stock Lua, which differentiates by differences
  uint64_t step_limit = 1'000'000;
  std::string problem; ///< a directive that cannot be understood
};
Directives read_directives(const std::string& text);

} // namespace moonshade::lang_test
