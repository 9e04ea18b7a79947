// The command line of shaderc, parsed.
#pragma once

#include "compiler/base/diagnostics.h"
#include "runtime/frontend.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::shaderc {

struct Options {
  /// Folders of modules, after the shader's own.
  std::vector<std::string> module_path;
  std::vector<std::string> files;
  CompileOptions compile;
  std::vector<std::string> definitions; ///< NAME=VALUE of -D

  std::optional<Stage> emit;
  std::string output; ///< of --emit; empty or "-": standard output
  std::string prefix; ///< of names in an object and its header; empty: from the file's name
  bool luals = false; ///< --emit=luals
  bool describe = false;

  bool run = false;
  std::vector<std::string> inputs; ///< NAME=VALUE of --input
  std::string points;              ///< a CSV file; empty: one point
  bool interpret = false;

  DiagnosticFormat diagnostics = DiagnosticFormat::Text;
  bool colour = false;
  bool time_report = false;
  bool remarks = false;
};

/// NAME=VALUE taken apart; the name is empty where the text is none.
struct Assignment {
  std::string_view name, value;
};
Assignment split_assignment(std::string_view text);

struct ParsedOptions {
  std::optional<Options> options; ///< nothing: end with `exit_status`, all is said
  int exit_status = 0;
};
ParsedOptions parse_options(int argc, char** argv);

/// Prints "shaderc: error: MESSAGE" and gives the status of a wrong call.
int call_error(const std::string& message);

} // namespace moonshade::shaderc
