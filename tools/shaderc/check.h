// Reading and checking one file, and printing what the checks found.
#pragma once

#include "tools/shaderc/options.h"

#include <memory>
#include <string>
#include <vector>

namespace moonshade::shaderc {

/// Prints diagnostics of several files in one form; JSON is one array for all of them, SARIF one log, at the end; both
/// also where there is nothing to say.
class Reporter {
public:
  explicit Reporter(const Options& options) : options_(options) {}
  void add(const Diagnostics& diagnostics, const SourceSet& sources);
  /// At the end of all files; a second call does nothing.
  void finish();

private:
  const Options& options_;
  std::vector<std::string> json_; // one array a file
  SarifLog sarif_;
  bool finished_ = false;
};

struct CheckedFile {
  std::unique_ptr<CheckedShader> shader; ///< null where the file could not be read
  int status = 0;                        ///< of the program, as far as this file goes
};
/// Reads and checks the file and reports what is wrong. An --entry that the shader does not have is the call's fault.
CheckedFile check_file(const std::string& path, const Options& options, Reporter& reporter);

/// --time-report: a line for each stage that was run.
void print_times(const std::string& file, const CompileTimes& times);

} // namespace moonshade::shaderc
