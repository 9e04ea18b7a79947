// --emit: one stage of the compiler as text or object file.
#include "compiler/base/printable.h"
#include "compiler/sema/luals.h"
#include "tools/shaderc/actions.h"
#include "tools/shaderc/check.h"
#include "tools/shaderc/parameters.h"
#include "tools/support/exit_status.h"
#include "tools/support/files.h"

#include <iostream>

namespace moonshade::shaderc {

namespace {

int write_output(const Options& options, const std::string& bytes) {
  const std::string output = options.output.empty() ? "-" : options.output;
  if (const std::string error = tools::write_file(output, bytes); !error.empty()) {
    std::cerr << "shaderc: error: cannot write '" << printable(output) << "': " << error << "\n";
    return tools::kMachineAtFault;
  }
  return tools::kDone;
}

} // namespace

int emit_luals(const Options& options) { return write_output(options, sema::luals_definitions()); }

int emit_stage(const CheckedShader& shader, const Options& options) {
  const Stage stage = options.emit.value_or(Stage::Ast);
  if (!shader.ok() && stage != Stage::Ast) return tools::kInputAtFault;
  CompileOptions compile_options = options.compile;
  if (options.compile.bake)
    if (const auto status = read_parameters(shader.info(), options, compile_options.baked)) return *status;
  const Emission emission = emit(shader, stage, compile_options, options.prefix);
  if (emission.is_too_large) {
    std::cerr << emission.error;
    return tools::kInputAtFault;
  }
  if (!emission.error.empty()) return call_error(emission.error);
  if (options.time_report) print_times(options.files[0], emission.times);
  if (const int status = write_output(options, emission.bytes); status != tools::kDone) return status;
  return shader.ok() ? tools::kDone : tools::kInputAtFault;
}

} // namespace moonshade::shaderc
