// The whole compiler, stage by stage, to object code: it ends with diagnostics or with code, the IR is sound after it
// was built and after the passes, and every stage prints.
#include "compiler/ir/verify.h"
#include "runtime/frontend.h"
#include "runtime/frontend_parts.h"
#include "tests/fuzz/target.h"

#include <array>

namespace moonshade {
namespace {

CompileOptions options_of(uint64_t choice) {
  constexpr std::array<unsigned, 3> kSmallWidths = {1, 4, 8};
  CompileOptions options;
  options.precision = choice & 1 ? Precision::F64 : Precision::F32;
  options.width = kSmallWidths[(choice >> 1) % kSmallWidths.size()];
  options.optimization = choice & 8 ? 2 : 0;
  options.cpu = "x86-64-v3";
  options.target = "x86_64-unknown-linux-gnu";
  if (choice & 16) options.uniform_inputs = {"time", "frame"};
  return options;
}

void check_module(const ir::Module& module, const char* when) {
  for (const std::string& violation : ir::verify(module))
    fuzz::fail(std::string("the IR is not sound ") + when + ": " + violation);
}

void check_stages(const CheckedShader& shader, const CompileOptions& options) {
  check_module(ir::build(shader.parts().program, {options.step_limit}), "as built");
  const ir::Module module = build_module(shader, options);
  check_module(module, "after the passes");
  fuzz::require(!emit(shader, Stage::Ir, options).bytes.empty(), "IR without text");
  codegen::Generated generated = codegen::generate(module, codegen_options(options));
  fuzz::require(generated.error.empty(), "no code: " + generated.error);
  fuzz::require(!generated.llvm_text().empty(), "LLVM IR without text");
  fuzz::require(!generated.object().empty() && generated.error.empty(), "no object code: " + generated.error);
}

} // namespace
} // namespace moonshade

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  if (size > fuzz::kMaxInput) return 0;
  const std::string_view text = fuzz::text_of(data, size);
  const CheckedShader shader("fuzz.lua", std::string(text));
  fuzz::check_diagnostics(shader.diagnostics(), shader.sources());
  const CompileOptions options = options_of(fuzz::choice_of(text));
  emit(shader, Stage::Ast, options);
  if (shader.ok()) check_stages(shader, options);
  return 0;
}
