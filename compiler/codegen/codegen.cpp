// The stages of code generation in order (codegen.h): emit, link the library, optimise, and the machine's code.
#include "compiler/codegen/codegen.h"

#include "compiler/codegen/c_interface_code.h"
#include "compiler/codegen/emitter.h"
#include "compiler/codegen/entry.h"
#include "compiler/codegen/fold_scales.h"
#include "compiler/codegen/link.h"
#include "compiler/codegen/load_constants.h"
#include "compiler/codegen/native_calls.h"
#include "compiler/codegen/pipeline.h"
#include "compiler/codegen/split_lanes.h"
#include "compiler/codegen/tables.h"
#include "compiler/codegen/target.h"
#include "compiler/codegen/width.h"

#include <llvm/ADT/SmallString.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/DiagnosticInfo.h>
#include <llvm/IR/DiagnosticPrinter.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/Support/raw_ostream.h>

#include <algorithm>
#include <chrono>

namespace moonshade::codegen {

struct Generated::Parts {
  Target target;
  std::string complaint; ///< of LLVM's code generator
  uint64_t stack = 0;    ///< of a function that takes too much of it
  std::shared_ptr<LibraryContext> library;
  std::unique_ptr<llvm::Module> module; ///< of the library's context
};

Generated::Generated() = default;
Generated::~Generated() = default;
Generated::Generated(Generated&&) noexcept = default;
Generated& Generated::operator=(Generated&&) noexcept = default;

namespace {

/// Beyond this many instructions in one function, the allocation of registers by graph takes quadratic time.
constexpr unsigned kLargeFunction = 15'000;
/// Beyond these, in one function, passes over control flow take quadratic time, and those over loops inside each other
/// exponential time. (Functions written by people stay below a hundred blocks.)
constexpr size_t kManyBlocks = 1000;
constexpr unsigned kDeepLoops = 12;
/// Blocks longer than this are cut where code is generated at level 0. Selection works on a block at a time and looks,
/// at each fused operation with a constant, at all uses of the constant in the block: quadratic time.
constexpr size_t kLongBlock = 1000;
/// Entry points for which optimised code would take seconds.
constexpr size_t kManyEntries = 500;
/// Operations of the IR, with functions emitted in place counted at each call: beyond this nothing is generated.
constexpr uint64_t kMaxOperations = 200'000;

/// Beyond this many of them, what is kept for the next compilation would keep megabytes.
constexpr uint64_t kMostKept = 10'000;

/// Bytes of stack for one function.
constexpr uint64_t kMaxStack = uint64_t{1} << 20;

/// What LLVM has to say while it generates code. (Its own handler would print, and end the process.)
void listen(const llvm::DiagnosticInfo* diagnostic, void* context) {
  auto& parts = *static_cast<Generated::Parts*>(context);
  if (diagnostic->getKind() == llvm::DK_StackSize)
    parts.stack = std::max(parts.stack, llvm::cast<llvm::DiagnosticInfoStackSize>(diagnostic)->getStackSize());
  if (diagnostic->getSeverity() != llvm::DS_Error || !parts.complaint.empty()) return;
  llvm::raw_string_ostream stream(parts.complaint);
  llvm::DiagnosticPrinterRawOStream printer(stream);
  diagnostic->print(printer);
}

class Stopwatch {
public:
  /// Milliseconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(begin_, now)).count();
  }

private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

FunctionAttributes attributes_for(const Target& target, const Domain& domain) {
  FunctionAttributes attributes{target.cpu, target.features, false, kMaxStack};
  const unsigned bits = domain.width * (domain.precision == Precision::F32 ? 32 : 64);
  attributes.wide = target.vector_bits == 512 && bits >= 512;
  return attributes;
}

/// What code for all functions of the module comes to.
uint64_t operations(const ir::Module& module) {
  const SizePlan plan = plan_sizes(module);
  uint64_t sum = 0;
  for (ir::FunctionId id = 0; id < module.functions.size(); ++id) {
    const bool is_entry = std::ranges::find(module.entries, id, &ir::Entry::function) != module.entries.end();
    if (is_entry || id == module.init || plan.outlined[id]) sum += plan.size[id];
  }
  return sum;
}

bool has_large_function(const llvm::Module& module) {
  return std::ranges::any_of(
      module, [](const llvm::Function& function) { return function.getInstructionCount() > kLargeFunction; });
}

bool has_tangled_function(llvm::Module& module) {
  return std::ranges::any_of(module, [](llvm::Function& function) {
    if (function.isDeclaration()) return false;
    if (function.size() > kManyBlocks) return true;
    const llvm::DominatorTree tree(function);
    const llvm::LoopInfo loops(tree);
    return std::ranges::any_of(function,
                               [&](const llvm::BasicBlock& block) { return loops.getLoopDepth(&block) > kDeepLoops; });
  });
}

/// From the end, so that nothing moves twice.
void cut_long_blocks(llvm::Module& module) {
  for (llvm::Function& function : module)
    for (llvm::BasicBlock& block : llvm::make_early_inc_range(function)) {
      size_t behind = 0;
      for (auto at = block.rbegin(); at != block.rend() && !llvm::isa<llvm::PHINode>(*at);) {
        llvm::Instruction& instruction = *at++;
        if (++behind % kLongBlock == 0) block.splitBasicBlock(&instruction);
      }
    }
}

void emit_module(Generated& generated, const ir::Module& module, const Options& options) {
  Generated::Parts& parts = *generated.parts;
  CodeInfo& info = generated.info;
  llvm::LLVMContext& context = parts.library->context;
  const Domain domain(context, info.precision, info.width), single(context, info.precision, 1);
  const FunctionAttributes attributes = attributes_for(parts.target, domain);
  const FaultPlaces places(module);
  ModuleEmitter emitter(*parts.module, module, domain, attributes, places);
  info.print_slot = emitter.layout.size; // the layout is aligned
  info.image_slot = emitter.image_slot = info.print_slot + sizeof(void*);
  emitter.calls_exports = options.optimization == 0 && options.library_calls == LibraryCalls::All &&
                          has_native_calls(parts.target, info.precision, info.width);
  if (options.prints) {
    emitter.prints = &info.prints;
    emitter.print_slot = info.print_slot;
  }
  for (const ir::Entry& entry : module.entries) {
    std::vector<bool> uniform;
    for (const std::string& name : module.functions[entry.function].parameter_names)
      uniform.push_back(std::ranges::find(options.uniform_inputs, name) != options.uniform_inputs.end());
    const std::string symbol = "moonshade_entry_" + entry.name;
    info.entries.push_back({symbol, emit_kernel(emitter, entry, symbol, uniform)});
  }
  info.global_offsets = emitter.layout.offsets;
  info.constants_size = emitter.layout.size;
  if (module.init != ir::kNone) {
    info.init_symbol = "moonshade_init";
    ModuleEmitter init(*parts.module, module, single, attributes, places);
    init.image_slot = info.image_slot;
    init.calls_exports = emitter.calls_exports;
    emit_init(init, info.init_symbol);
  }
  for (const ir::Instruction* place : places.places) {
    const FaultCode code = place->op == ir::Op::Step ? FaultCode::StepLimit : place->fault;
    info.places.push_back({code, place->span, place->text});
    for (EntryCode& entry : info.entries)
      entry.info.site_codes.push_back(code);
  }
#ifndef NDEBUG
  if (std::string complaint = verify(*parts.module); !complaint.empty())
    generated.error = "internal error: " + complaint;
#endif
  if (!generated.error.empty()) return;
  choose_native_calls(*parts.module, parts.target, options.library_calls);
  link_library(*parts.module, *parts.library, domain, attributes, generated.error);
  if (generated.error.empty()) define_tables(*parts.module, parts.target);
}

/// What LLVM complained of while it generated code.
void take_complaints(Generated& generated) {
  if (!generated.parts->complaint.empty()) generated.error = generated.parts->complaint;
  if (generated.parts->stack > kMaxStack) {
    generated.error = "a function's values take " + std::to_string(generated.parts->stack) + " bytes of stack";
    generated.exceeded_limit = kMaxStack;
  }
}

} // namespace

std::string Generated::llvm_text() const {
  std::string text;
  llvm::raw_string_ostream stream(text);
  parts->module->print(stream, nullptr);
  return text;
}

std::string Generated::assembly() {
  llvm::SmallString<0> text;
  llvm::raw_svector_ostream stream(text);
  llvm::legacy::PassManager passes;
  if (parts->target.machine->addPassesToEmitFile(passes, stream, nullptr, llvm::CodeGenFileType::AssemblyFile)) {
    error = "the target cannot emit assembly";
    return {};
  }
  passes.run(*parts->module);
  take_complaints(*this);
  return error.empty() ? std::string(text) : std::string();
}

std::string Generated::object() {
  Stopwatch watch;
  ObjectPasses& passes = parts->target.kept->passes();
  if (passes.cannot_emit()) {
    error = "the target cannot emit object files";
    return {};
  }
  std::string bytes = passes.run(*parts->module);
  times.codegen = watch.lap();
  take_complaints(*this);
  return error.empty() ? bytes : std::string();
}

std::string Generated::c_object(const CInterface& interface) {
  const Domain domain(parts->library->context, info.precision, info.width);
  error = add_c_interface(*parts->module, interface, info, attributes_for(parts->target, domain));
#ifndef NDEBUG
  if (std::string complaint = verify(*parts->module); !complaint.empty()) error = "internal error: " + complaint;
#endif
  return error.empty() ? object() : std::string();
}

Generated generate(const ir::Module& module, const Options& options) {
  Stopwatch watch;
  Generated generated;
  generated.parts = std::make_unique<Generated::Parts>();
  Generated::Parts& parts = *generated.parts;
  parts.target = make_target({options.cpu, options.triple, options.optimization});
  if (!parts.target.error.empty()) {
    generated.error = parts.target.error;
    return generated;
  }
  generated.runs_here = parts.target.native;
  generated.info.precision = options.precision;
  generated.info.width = choose_width(module, parts.target, options).width;
  if (!module.problems.empty()) {
    generated.error = module.problems.front();
    return generated;
  }
  const uint64_t size = operations(module);
  if (size > kMaxOperations) {
    generated.error = "the shader comes to " + std::to_string(size) + " operations";
    generated.exceeded_limit = kMaxOperations;
    return generated;
  }
  parts.target.kept->is_worn = size > kMostKept;
  parts.library = LibraryContext::take(size);
  parts.library->context.setDiagnosticHandlerCallBack(listen, &parts);
  parts.module = std::make_unique<llvm::Module>("shader", parts.library->context);
  parts.module->setTargetTriple(parts.target.machine->getTargetTriple().str());
  parts.module->setDataLayout(parts.target.machine->createDataLayout());
  emit_module(generated, module, options);
  generated.times.emit = watch.lap();
  if (!generated.error.empty()) return generated;
  const bool too_costly = module.entries.size() > kManyEntries || has_tangled_function(*parts.module);
  optimize(*parts.module, *parts.target.machine, too_costly ? kInlineOnly : options.optimization);
  const bool costly = too_costly || has_large_function(*parts.module);
  if (costly) {
    parts.target.machine->setOptLevel(llvm::CodeGenOptLevel::None);
    cut_long_blocks(*parts.module);
  }
  if (costly || options.optimization == 0) load_constants(*parts.module);
  if (!costly && options.optimization > 0) {
    fold_scales(*parts.module);
    split_lanes(*parts.module, generated.info.width, best_width(parts.target, options.precision));
  }
  generated.times.optimize = watch.lap();
#ifndef NDEBUG
  if (std::string complaint = verify(*parts.module); !complaint.empty())
    generated.error = "internal error: " + complaint;
#endif
  return generated;
}

} // namespace moonshade::codegen
