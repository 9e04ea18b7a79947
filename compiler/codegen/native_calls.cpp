// Chooses by size (native_calls.h).
#include "compiler/codegen/native_calls.h"

#include "compiler/codegen/tables.h"
#include "stdlib/native_library.h"

#include <llvm/IR/Function.h>

#include <vector>

namespace moonshade::codegen {

namespace {

/// Before the export's name in the name that is called.
constexpr std::string_view kPrefix = "native_";
/// Instructions of bitcode up to which a function is always inlined: a call would be no shorter.
constexpr size_t kSmall = 40;
/// LibraryCalls::Large: what all others may come to in a shader without one of them being called. It has room for one
/// evaluation of noise, where a call would be felt; a shader with more than that compiles for milliseconds otherwise,
/// and has so much to compute that calls hardly count.
constexpr size_t kBudget = 250;

/// The domain's machine code that runs on the target.
class CodeThatRuns {
public:
  CodeThatRuns(const Domain& domain, const Target& target) {
    for (const unsigned width : {domain.width, 1u})
      for (const bool derivatives : {false, true}) {
        const NativeExports exports = native_exports(domain.precision, width, derivatives);
        if (exports.exports.empty()) continue;
        if (tables_.empty() || tables_.back().exports.processor != exports.processor)
          runs_ = runs_code_of(target, exports.processor);
        if (runs_) tables_.push_back({"_w" + std::to_string(width), derivatives, exports});
      }
  }

  const NativeExport* find(const llvm::Function& function) const {
    const llvm::StringRef name = function.getName();
    if (!function.isDeclaration() || !name.starts_with("ms_") || export_order(name) == 2) return nullptr;
    for (const Table& table : tables_)
      if (name.ends_with(table.ending) && is_derivative_export(name) == table.derivatives)
        return table.exports.find(name);
    return nullptr;
  }

private:
  struct Table {
    std::string ending;
    bool derivatives;
    NativeExports exports;
  };
  std::vector<Table> tables_;
  bool runs_ = false;
};

/// What the library promises of its functions (library.h).
void call(llvm::Function& function) {
  function.setName(std::string(kPrefix) + function.getName().str());
  function.setMemoryEffects(llvm::MemoryEffects::argMemOnly());
  function.setDoesNotThrow();
  function.setWillReturn();
  for (llvm::Argument& argument : function.args())
    argument.addAttr(llvm::Attribute::NoCapture);
}

} // namespace

void choose_native_calls(llvm::Module& module, const Domain& domain, const Target& target, LibraryCalls calls) {
  if (calls == LibraryCalls::None || !target.native) return;
  const CodeThatRuns native(domain, target);
  std::vector<llvm::Function*> large;
  size_t sum = 0;
  // Look-ups in registers are twice as fast as machine code that gathers.
  const bool keeps_tables = calls == LibraryCalls::Large && has_tables(target);
  for (llvm::Function& function : module)
    if (const NativeExport* code = native.find(function);
        code != nullptr && code->instructions > kSmall && !(keeps_tables && code->asks_for_tables != 0)) {
      large.push_back(&function);
      sum += code->instructions;
    }
  if (calls == LibraryCalls::Large && sum <= kBudget) return;
  for (llvm::Function* function : large)
    call(*function);
}

const void* native_call_address(const std::string& name) {
  std::string_view rest = name;
  if (!rest.starts_with(kPrefix)) return nullptr;
  rest.remove_prefix(kPrefix.size());
  const bool derivatives = is_derivative_export(rest);
  for (const Precision precision : {Precision::F32, Precision::F64})
    for (const unsigned width : kWidths) {
      const std::string domain = (precision == Precision::F32 ? "_f32_w" : "_f64_w") + std::to_string(width);
      if (!rest.ends_with(domain)) continue;
      const NativeExport* code = native_exports(precision, width, derivatives).find(rest);
      return code != nullptr ? code->address : nullptr;
    }
  return nullptr;
}

} // namespace moonshade::codegen
