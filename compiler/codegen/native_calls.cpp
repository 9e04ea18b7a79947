// Chooses by size (native_calls.h).
#include "compiler/codegen/native_calls.h"

#include "compiler/codegen/tables.h"
#include "stdlib/native_library.h"

#include <llvm/IR/Function.h>

#include <map>
#include <vector>

namespace moonshade::codegen {

namespace {

/// Before the export's name in the name that is called.
constexpr std::string_view kPrefix = "native_";
/// Instructions of bitcode up to which a function is always inlined: a call would be no shorter.
constexpr size_t kSmall = 40;
/// LibraryCalls::All: what a small function may come to at all its calls together.
constexpr size_t kRepeated = 200;
/// LibraryCalls::Large: what all others may come to in a shader without one of them being called. It has room for one
/// evaluation of noise, where a call would be felt; a shader with more than that compiles for milliseconds otherwise,
/// and has so much to compute that calls hardly count.
constexpr size_t kBudget = 250;

/// The machine code of the domain whose export has this name; empty where there is none.
NativeExports domain_of(std::string_view name) {
  if (export_order(name) == 2) return {};
  for (const Precision precision : {Precision::F32, Precision::F64})
    for (const unsigned width : kWidths)
      if (name.ends_with(export_ending(precision, width)))
        return native_exports(precision, width, is_derivative_export(name));
  return {};
}

/// The machine code of exports, where it runs on the target.
class CodeThatRuns {
public:
  explicit CodeThatRuns(const Target& target) : target_(target) {}

  const NativeExport* find(const llvm::Function& function) {
    const std::string_view name(function.getName().data(), function.getName().size());
    if (!function.isDeclaration() || !name.starts_with("ms_")) return nullptr;
    const NativeExports domain = domain_of(name);
    return !domain.exports.empty() && runs(domain.processor) ? domain.find(name) : nullptr;
  }

private:
  bool runs(std::string_view processor) {
    const auto [known, is_new] = known_.try_emplace(processor);
    if (is_new) known->second = runs_code_of(target_, processor);
    return known->second;
  }

  const Target& target_;
  std::map<std::string_view, bool> known_; ///< by processor
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

bool has_native_calls(const Target& target, Precision precision, unsigned width) {
  const auto has = [&](unsigned lanes) {
    const NativeExports domain = native_exports(precision, lanes, false);
    return !domain.exports.empty() && runs_code_of(target, domain.processor);
  };
  return target.native && has(width) && (width == 1 || has(1));
}

void choose_native_calls(llvm::Module& module, const Target& target, LibraryCalls calls) {
  if (calls == LibraryCalls::None || !target.native) return;
  CodeThatRuns native(target);
  std::vector<llvm::Function*> large;
  size_t sum = 0;
  // Look-ups in registers are twice as fast as machine code that gathers.
  const bool keeps_tables = calls == LibraryCalls::Large && has_tables(target);
  for (llvm::Function& function : module)
    if (const NativeExport* code = native.find(function); code != nullptr) {
      const bool repeated = calls == LibraryCalls::All && code->instructions * function.getNumUses() > kRepeated;
      if (code->instructions <= kSmall && !repeated) continue;
      if (keeps_tables && code->asks_for_tables != 0) continue;
      large.push_back(&function);
      sum += code->instructions;
    }
  if (calls == LibraryCalls::Large && sum <= kBudget) return;
  for (llvm::Function* function : large)
    call(*function);
}

const void* native_call_address(std::string_view name) {
  if (!name.starts_with(kPrefix)) return nullptr;
  name.remove_prefix(kPrefix.size());
  const NativeExport* code = domain_of(name).find(name);
  return code != nullptr ? code->address : nullptr;
}

} // namespace moonshade::codegen
