// Sets up LLVM's targets once for the process, and target machines from options.
#include "compiler/codegen/target.h"

#include <llvm/ADT/StringMap.h>
#include <llvm/MC/MCSubtargetInfo.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/SubtargetFeature.h>
#include <llvm/TargetParser/Triple.h>

#include <algorithm>
#include <mutex>

namespace moonshade::codegen {

namespace {

/// All targets at once: a later registration would disturb other threads' look-ups. It costs nothing to speak of.
void initialise_llvm() {
  static std::once_flag once;
  std::call_once(once, [] {
    llvm::InitializeAllTargetInfos();
    llvm::InitializeAllTargets();
    llvm::InitializeAllTargetMCs();
    llvm::InitializeAllAsmPrinters();
  });
}

std::string host_features() {
  llvm::SubtargetFeatures features;
  for (const auto& feature : llvm::sys::getHostCPUFeatures())
    features.AddFeature(feature.getKey(), feature.getValue());
  return features.getString();
}

llvm::CodeGenOptLevel code_generation_level(int optimization) {
  switch (optimization) {
  case 0:
    return llvm::CodeGenOptLevel::None;
  case 1:
    return llvm::CodeGenOptLevel::Less;
  case 2:
    return llvm::CodeGenOptLevel::Default;
  default:
    return llvm::CodeGenOptLevel::Aggressive;
  }
}

llvm::TargetOptions strict_options() {
  llvm::TargetOptions options;
  options.AllowFPOpFusion = llvm::FPOpFusion::Strict;
  options.UnsafeFPMath = false;
  options.NoInfsFPMath = false;
  options.NoNaNsFPMath = false;
  options.NoSignedZerosFPMath = false;
  return options;
}

/// Whether this machine has all that the processor has.
bool runs_here(const llvm::MCSubtargetInfo& processor) {
  for (const auto& feature : llvm::sys::getHostCPUFeatures())
    if (!feature.getValue() && processor.checkFeatures(("+" + feature.getKey()).str())) return false;
  return true;
}

bool has_feature(const llvm::TargetMachine& machine, const char* feature) {
  return machine.getMCSubtargetInfo()->checkFeatures(std::string("+") + feature);
}

unsigned widest_vector(const llvm::TargetMachine& machine) {
  if (!machine.getTargetTriple().isX86()) return 128;
  if (has_feature(machine, "avx512f") && has_feature(machine, "avx512dq") && has_feature(machine, "avx512bw") &&
      has_feature(machine, "avx512vl"))
    return 512;
  return has_feature(machine, "avx2") ? 256 : 128;
}

} // namespace

Target make_target(const TargetOptions& options) {
  Target target;
  initialise_llvm();
  const std::string host = llvm::sys::getProcessTriple();
  const std::string name = options.triple.empty() ? host : llvm::Triple::normalize(options.triple);
  const llvm::Triple triple(name);
  const bool same_machine = triple.getArch() == llvm::Triple(host).getArch();
  std::string error;
  const llvm::Target* llvm_target = llvm::TargetRegistry::lookupTarget(name, error);
  if (llvm_target == nullptr) {
    target.error = "unknown target '" + options.triple + "'";
    return target;
  }
  if (options.cpu == "native") {
    target.native = options.triple.empty() || name == host;
    target.cpu = same_machine ? llvm::sys::getHostCPUName().str() : "generic";
    target.features = same_machine ? host_features() : "";
  } else {
    std::unique_ptr<llvm::MCSubtargetInfo> known(llvm_target->createMCSubtargetInfo(name, "", ""));
    if (known == nullptr || !known->isCPUStringValid(options.cpu)) {
      target.error = "unknown CPU '" + options.cpu + "' for target '" + name + "'";
      return target;
    }
    target.cpu = options.cpu;
    target.native = (options.triple.empty() || name == host) && runs_here(*known);
  }
  target.machine.reset(llvm_target->createTargetMachine(name, target.cpu, target.features, strict_options(),
                                                        llvm::Reloc::PIC_, llvm::CodeModel::Small,
                                                        code_generation_level(options.optimization)));
  if (target.machine == nullptr) {
    target.error = "no code can be made for target '" + name + "'";
    return target;
  }
  target.vector_bits = widest_vector(*target.machine);
  return target;
}

unsigned best_width(const Target& target, Precision precision) {
  return std::max(4U, target.vector_bits / (precision == Precision::F32 ? 32 : 64)); // no code is made for two lanes
}

unsigned native_width(Precision precision) { return best_width(make_target({}), precision); }

} // namespace moonshade::codegen
