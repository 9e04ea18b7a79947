// Sets up LLVM's targets once for the process, and target machines from options.
#include "compiler/codegen/target.h"

#include "compiler/codegen/codegen.h"
#include "compiler/codegen/idle.h"

#include <llvm/ADT/StringMap.h>
#include <llvm/MC/MCSubtargetInfo.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/SubtargetFeature.h>
#include <llvm/TargetParser/Triple.h>
#include <llvm/TargetParser/X86TargetParser.h>

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

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

/// Asked once, as what follows: a virtual machine takes long to answer CPUID.
const std::string& host_cpu() {
  static const std::string name = llvm::sys::getHostCPUName().str();
  return name;
}

const std::string& host_features() {
  static const std::string text = [] {
    llvm::SubtargetFeatures features;
    for (const auto& feature : llvm::sys::getHostCPUFeatures())
      features.AddFeature(feature.getKey(), feature.getValue());
    return features.getString();
  }();
  return text;
}

/// Making a machine, and what it works out about its processor, takes longer than small shaders do. All that can be set
/// of one is set anew.
Idle<Machine>& idle_machines() {
  static auto* machines = new Idle<Machine>;
  return *machines;
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

/// LLVM's own question, MCSubtargetInfo::checkFeatures, works out anew all that the feature implies: for the forty that
/// a compilation asks, a twelfth of the time that a small shader takes.
bool has_feature(const llvm::MCSubtargetInfo& processor, llvm::StringRef feature) {
  const llvm::ArrayRef<llvm::SubtargetFeatureKV> known = processor.getAllProcessorFeatures(); // sorted
  const auto* found = std::lower_bound(known.begin(), known.end(), feature);
  return found != known.end() && feature == found->Key && processor.hasFeature(found->Value);
}

/// Whether this machine has all that the processor has.
bool runs_here(const llvm::MCSubtargetInfo& processor) {
  for (const auto& feature : llvm::sys::getHostCPUFeatures())
    if (!feature.getValue() && has_feature(processor, feature.getKey())) return false;
  return true;
}

unsigned widest_vector(const llvm::TargetMachine& machine) {
  if (!machine.getTargetTriple().isX86()) return 128;
  const auto has = [&](llvm::StringRef feature) { return has_feature(*machine.getMCSubtargetInfo(), feature); };
  if (has("avx512f") && has("avx512dq") && has("avx512bw") && has("avx512vl")) return 512;
  return has("avx2") ? 256 : 128;
}

} // namespace

namespace {

/// Names the target; without its machine.
const llvm::Target* name_target(const TargetOptions& options, Target& target, std::string& name) {
  initialise_llvm();
  const std::string host = llvm::sys::getProcessTriple();
  name = options.triple.empty() ? host : llvm::Triple::normalize(options.triple);
  const bool same_machine = llvm::Triple(name).getArch() == llvm::Triple(host).getArch();
  std::string error;
  const llvm::Target* llvm_target = llvm::TargetRegistry::lookupTarget(name, error);
  if (llvm_target == nullptr) {
    target.error = "unknown target '" + options.triple + "'";
    return nullptr;
  }
  if (options.cpu == "native") {
    target.native = options.triple.empty() || name == host;
    target.cpu = same_machine ? host_cpu() : "generic";
    target.features = same_machine ? host_features() : "";
  } else {
    std::unique_ptr<llvm::MCSubtargetInfo> known(llvm_target->createMCSubtargetInfo(name, "", ""));
    if (known == nullptr || !known->isCPUStringValid(options.cpu)) {
      target.error = "unknown CPU '" + options.cpu + "' for target '" + name + "'";
      return nullptr;
    }
    target.cpu = options.cpu;
    target.native = (options.triple.empty() || name == host) && runs_here(*known);
  }
  return llvm_target;
}

std::string key_of(const Target& target, const std::string& name) {
  return name + '|' + target.cpu + '|' + target.features;
}

} // namespace

std::string describe_target(const std::string& cpu, const std::string& triple) {
  Target target;
  std::string name;
  name_target({cpu, triple}, target, name);
  return key_of(target, name);
}

ObjectPasses& Machine::passes() {
  const llvm::CodeGenOptLevel level = target->getOptLevel();
  ObjectPasses& passes = object_passes.try_emplace(level, *target).first->second;
  target->setFastISel(level == llvm::CodeGenOptLevel::None); // which their making does
  return passes;
}

Target make_target(const TargetOptions& options) {
  Target target;
  std::string name;
  const llvm::Target* llvm_target = name_target(options, target, name);
  if (llvm_target == nullptr) return target;
  const llvm::CodeGenOptLevel level = code_generation_level(options.optimization);
  std::string key = key_of(target, name);
  std::unique_ptr<Machine> machine = idle_machines().take(key);
  if (machine == nullptr) {
    machine = std::make_unique<Machine>();
    machine->target.reset(llvm_target->createTargetMachine(name, target.cpu, target.features, strict_options(),
                                                           llvm::Reloc::PIC_, llvm::CodeModel::Small, level));
  }
  if (machine->target == nullptr) {
    target.error = "no code can be made for target '" + name + "'";
    return target;
  }
  target.machine = machine->target.get();
  target.machine->setOptLevel(level);
  target.machine->setFastISel(false); // which level 0 sets, and no other level takes back
  target.kept = {machine.release(), [key = std::move(key)](Machine* done) {
                   std::unique_ptr<Machine> idle(done);
                   if (!idle->is_worn) idle_machines().give_back(key, std::move(idle));
                 }};
  target.vector_bits = widest_vector(*target.machine);
  return target;
}

bool has_feature(const Target& target, std::string_view feature) {
  return has_feature(*target.machine->getMCSubtargetInfo(), llvm::StringRef(feature.data(), feature.size()));
}

bool runs_code_of(const Target& target, std::string_view processor) {
  if (processor.empty()) return true;
  llvm::SmallVector<llvm::StringRef, 64> features;
  llvm::X86::getFeaturesForCPU(llvm::StringRef(processor.data(), processor.size()), features);
  return std::ranges::all_of(
      features, [&](llvm::StringRef feature) { return feature == "64bit" || has_feature(target, feature); });
}

unsigned best_width(const Target& target, Precision precision) {
  return std::max(4U, target.vector_bits / (precision == Precision::F32 ? 32 : 64)); // no code is made for two lanes
}

unsigned native_width(Precision precision) { return best_width(make_target({}), precision); }

} // namespace moonshade::codegen
