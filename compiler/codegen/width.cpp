// Two registers a value give the processor two chains of operations to run by turns, at the price of twice the code.
// Measured over the workloads of docs/speed.md: 1.4 times as fast for a loop of a few operations (Mandelbrot), 1.1 for
// short straight code, 1.0 to 1.07 around one noise. Where several long functions are inlined nothing is won and
// compiling takes nearly twice as long.
#include "compiler/codegen/width.h"

#include "compiler/codegen/facts.h"

#include <algorithm>
#include <set>

namespace moonshade::codegen {

namespace {

/// What a library function that is no mere formula counts for; called more than once it stays one function.
constexpr uint64_t kLongFunction = 150;
/// Two of them and the code around, or less: short.
constexpr uint64_t kShort = 400;
/// One with its derivatives: they take all registers (97 against 82 million gradients of four octaves of noise a
/// second).
constexpr uint64_t kLongDerivative = kShort + 1;

bool is_formula(const LibraryFunction& row) {
  return row.componentwise || row.name.starts_with("op.") || row.name.starts_with("math.") || is_linear_algebra(row);
}

/// Operations of all entries and functions that they call, emitted in place.
uint64_t code_size(const ir::Module& module) {
  const SizePlan plan = plan_sizes(module);
  uint64_t size = 0;
  std::set<std::string_view> long_functions;
  for (ir::FunctionId id = 0; id < module.functions.size(); ++id) {
    const ir::Function& function = module.functions[id];
    const bool is_entry = std::ranges::find(module.entries, id, &ir::Entry::function) != module.entries.end();
    if (is_entry || plan.outlined[id]) size += plan.size[id];
    if (id == module.init) continue;
    each_instruction(function, function.body, [&](const ir::Instruction& instruction) {
      if (instruction.op == ir::Op::CallLibrary && !is_formula(*instruction.library))
        long_functions.insert(instruction.library->symbol);
    });
  }
  for (const std::string_view symbol : long_functions)
    size += is_derivative_export(symbol) ? kLongDerivative : kLongFunction;
  return size;
}

} // namespace

WidthChoice choose_width(const ir::Module& module, const Target& target, const Options& options) {
  if (options.width != 0) return {options.width, "as asked"};
  const unsigned native = best_width(target, options.precision);
  const bool may_double = options.precision == Precision::F32 && target.vector_bits >= 256;
  if (!may_double) return {native, "one register a value"};
  if (code_size(module) > kShort) return {native, "one register a value, as the code is long"};
  return {2 * native, "two registers a value, as the code is short"};
}

} // namespace moonshade::codegen
