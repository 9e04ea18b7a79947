// Reading and checking one file, and printing what the checks found.
#pragma once

#include "tools/shaderc/options.h"

#include <memory>
#include <string>
#include <vector>

namespace moonshade::shaderc {

/// Prints diagnostics of several files in one form; JSON is one array for all of them, SARIF one log, at the end.
class Reporter {
public:
  explicit Reporter(const Options& options) : options_(options) {}
  void add(const Diagnostics& diagnostics, const SourceSet& sources);
  /// Once, at the end of all files.
  void finish();

private:
  const Options& options_;
  std::vector<std::string> json_; // one array a file
  SarifLog sarif_;
};

/// The file, checked, its diagnostics reported. Null where it could not be read (which is reported, too).
std::unique_ptr<CheckedShader> check_file(const std::string& path, const Options& options, Reporter& reporter);

} // namespace moonshade::shaderc
