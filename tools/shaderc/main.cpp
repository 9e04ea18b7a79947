// shaderc: checks shaders, shows what the compiler makes of them, and evaluates them at points.
#include "tools/shaderc/actions.h"
#include "tools/shaderc/check.h"
#include "tools/shaderc/describe.h"
#include "tools/shaderc/options.h"
#include "tools/support/exit_status.h"
#include "tools/support/files.h"
#include "tools/support/interrupt.h"

#include <algorithm>
#include <exception>
#include <iostream>

namespace {

using namespace moonshade;
using namespace moonshade::shaderc;

/// The default action and --describe, for any number of files.
int check_files(const Options& options, Reporter& reporter) {
  int status = tools::kDone;
  std::vector<std::string> descriptions;
  for (const std::string& file : options.files) {
    const CheckedFile checked = check_file(file, options, reporter);
    status = std::max(status, checked.status);
    if (options.time_report && checked.shader) print_times(file, checked.shader->times());
    if (options.describe && checked.status == tools::kDone)
      descriptions.push_back(describe(file, checked.shader->info()));
  }
  if (!options.describe || status != tools::kDone) return status;
  if (descriptions.size() == 1) {
    std::cout << descriptions[0] << "\n";
    return status;
  }
  std::cout << "[";
  for (size_t i = 0; i < descriptions.size(); ++i)
    std::cout << (i == 0 ? "\n" : ",\n") << descriptions[i];
  std::cout << "\n]\n";
  return status;
}

int work(const Options& options) {
  if (options.luals) return emit_luals(options);
  Reporter reporter(options);
  int status = tools::kDone;
  if (!options.emit && !options.run) {
    status = check_files(options, reporter);
  } else {
    const CheckedFile checked = check_file(options.files[0], options, reporter);
    reporter.finish(); // before anything that the run has to say
    status = checked.status;
    if (!checked.shader) return status;
    if (options.emit)
      status = emit_stage(*checked.shader, options);
    else if (status == tools::kDone)
      status = run_shader(*checked.shader, options);
  }
  reporter.finish();
  return status;
}

} // namespace

int main(int argc, char** argv) {
  tools::keep_standard_files_apart();
  tools::exit_on_interrupt();
  try {
    const ParsedOptions parsed = parse_options(argc, argv);
    if (!parsed.options) return parsed.exit_status;
    const int status = work(*parsed.options);
    if (tools::finish_output("shaderc") == tools::kDone) return status;
  } catch (const std::exception& error) {
    std::cerr << "shaderc: internal error: " << error.what() << "\n";
  }
  return tools::kMachineAtFault;
}
