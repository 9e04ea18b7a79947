// The pass pipelines of -O0 to -O3 (pipeline.h). No vectoriser, no unroller of consequence, no pass that knows the
// mathematics of the C library.
#include "compiler/codegen/pipeline.h"

#include <llvm/Analysis/TargetLibraryInfo.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Transforms/IPO/GlobalDCE.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar/ADCE.h>
#include <llvm/Transforms/Scalar/EarlyCSE.h>
#include <llvm/Transforms/Scalar/GVN.h>
#include <llvm/Transforms/Scalar/LICM.h>
#include <llvm/Transforms/Scalar/LoopPassManager.h>
#include <llvm/Transforms/Scalar/LoopRotation.h>
#include <llvm/Transforms/Scalar/SROA.h>
#include <llvm/Transforms/Scalar/SimplifyCFG.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/Mem2Reg.h>

namespace moonshade::codegen {

namespace {

/// A library function that comes to more instructions than this at all its calls is called rather than inlined.
constexpr size_t kInlineBudget = 200;

/// While library functions are still calls of pure functions: merges equal calls, takes uniform ones out of the loop
/// over blocks, drops those without a use.
llvm::FunctionPassManager early_passes() {
  llvm::FunctionPassManager passes;
  passes.addPass(llvm::SROAPass(llvm::SROAOptions::ModifyCFG));
  passes.addPass(llvm::EarlyCSEPass(true));
  passes.addPass(llvm::createFunctionToLoopPassAdaptor(llvm::LICMPass(llvm::LICMOptions()), /*UseMemorySSA=*/true));
  return passes;
}

llvm::FunctionPassManager late_passes(int level) {
  llvm::FunctionPassManager passes;
  passes.addPass(llvm::SROAPass(llvm::SROAOptions::ModifyCFG));
  passes.addPass(llvm::EarlyCSEPass(level > 1));
  passes.addPass(llvm::SimplifyCFGPass());
  passes.addPass(llvm::InstCombinePass());
  if (level > 1) {
    llvm::LoopPassManager loops;
    loops.addPass(llvm::LoopRotatePass());
    loops.addPass(llvm::LICMPass(llvm::LICMOptions()));
    passes.addPass(llvm::createFunctionToLoopPassAdaptor(std::move(loops), /*UseMemorySSA=*/true));
    passes.addPass(llvm::GVNPass());
    passes.addPass(llvm::InstCombinePass());
  }
  passes.addPass(llvm::SimplifyCFGPass());
  passes.addPass(llvm::ADCEPass());
  return passes;
}

/// At level 0, where selection takes most of the time: what takes less time than the selection of what it removes.
llvm::FunctionPassManager quick_passes() {
  llvm::FunctionPassManager passes;
  passes.addPass(llvm::PromotePass()); // most variables, for a part of the time
  passes.addPass(llvm::SROAPass(llvm::SROAOptions::PreserveCFG));
  passes.addPass(llvm::SimplifyCFGPass());
  passes.addPass(llvm::EarlyCSEPass(false));
  return passes;
}

/// Emitted from the IR: neither of the library nor a wrapper around a function of it.
bool is_own(const llvm::Function& function) {
  return !function.isDeclaration() && !function.doesNotAccessMemory() &&
         !function.hasFnAttribute(llvm::Attribute::AlwaysInline);
}

/// The size of a wrapper: that of the library function in it.
size_t size_of(const llvm::Function& wrapper) {
  size_t size = 0;
  for (const llvm::BasicBlock& block : wrapper)
    for (const llvm::Instruction& instruction : block) {
      const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
      const llvm::Function* callee = call != nullptr ? call->getCalledFunction() : nullptr;
      size += callee != nullptr ? callee->getInstructionCount() : 1;
    }
  return size;
}

/// Now that it is known how often each library function is called, decides which are inlined.
void choose_inlining(llvm::Module& module) {
  for (llvm::Function& function : module) {
    if (function.isDeclaration() || !function.doesNotAccessMemory() || !function.hasLocalLinkage()) continue;
    const size_t calls = function.getNumUses();
    const bool in_place = calls <= 1 || calls * size_of(function) <= kInlineBudget;
    function.addFnAttr(in_place ? llvm::Attribute::AlwaysInline : llvm::Attribute::NoInline);
  }
}

/// Inlines what must be. (LLVM's pass for this works out how often each block runs, for profiles that there are not.)
struct InlineCalls : llvm::PassInfoMixin<InlineCalls> {
  llvm::PreservedAnalyses run(llvm::Module& module, llvm::ModuleAnalysisManager& analyses) {
    // Named, so that what is known of functions is forgotten with this pass.
    analyses.getResult<llvm::FunctionAnalysisManagerModuleProxy>(module);
    for (llvm::Function& function : llvm::make_early_inc_range(module)) {
      if (function.isDeclaration() || !function.hasFnAttribute(llvm::Attribute::AlwaysInline)) continue;
      for (llvm::User* user : llvm::make_early_inc_range(function.users()))
        if (auto* call = llvm::dyn_cast<llvm::CallBase>(user);
            call != nullptr && call->getCalledFunction() == &function) {
          llvm::InlineFunctionInfo info;
          llvm::InlineFunction(*call, info, /*MergeAttributes=*/true, /*CalleeAAR=*/nullptr, /*InsertLifetime=*/false);
        }
      if (function.use_empty() && function.hasLocalLinkage()) function.eraseFromParent();
    }
    return llvm::PreservedAnalyses::none();
  }
};

} // namespace

void optimize(llvm::Module& module, llvm::TargetMachine& machine, int level) {
  llvm::LoopAnalysisManager loops;
  llvm::FunctionAnalysisManager functions;
  llvm::CGSCCAnalysisManager components;
  llvm::ModuleAnalysisManager modules;
  llvm::PassBuilder builder(&machine);
  llvm::TargetLibraryInfoImpl no_library(machine.getTargetTriple());
  no_library.disableAllFunctions();
  functions.registerPass([&] { return llvm::TargetLibraryAnalysis(no_library); });
  builder.registerModuleAnalyses(modules);
  builder.registerCGSCCAnalyses(components);
  builder.registerFunctionAnalyses(functions);
  builder.registerLoopAnalyses(loops);
  builder.crossRegisterProxies(loops, functions, components, modules);
  if (level > 0) {
    llvm::FunctionPassManager early = early_passes();
    for (llvm::Function& function : module)
      if (is_own(function)) functions.invalidate(function, early.run(function, functions));
  }
  choose_inlining(module);
  llvm::ModulePassManager passes;
  passes.addPass(InlineCalls());
  passes.addPass(llvm::GlobalDCEPass());
  if (level == 0) passes.addPass(llvm::createModuleToFunctionPassAdaptor(quick_passes()));
  if (level > 0) passes.addPass(llvm::createModuleToFunctionPassAdaptor(late_passes(level)));
  passes.run(module, modules);
}

std::string verify(const llvm::Module& module) {
  std::string complaint;
  llvm::raw_string_ostream stream(complaint);
  llvm::verifyModule(module, &stream);
  return complaint;
}

} // namespace moonshade::codegen
