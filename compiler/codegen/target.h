// The machine that code is made for: LLVM's TargetMachine for a triple and CPU, with strict floating point.
// The native machine's features come from CPUID, not from the CPU's name: virtual machines mask the model.
#pragma once

#include "compiler/codegen/object_passes.h"
#include "stdlib/library.h"

#include <llvm/Target/TargetMachine.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace moonshade::codegen {

struct TargetOptions {
  std::string cpu = "native"; ///< "native" or a name of LLVM's
  std::string triple;         ///< empty: this machine's
  int optimization = 2;       ///< 0 to 3
};

/// A machine and what belongs to it, as they wait for the next compilation.
struct Machine {
  std::unique_ptr<llvm::TargetMachine> target;
  std::map<llvm::CodeGenOptLevel, ObjectPasses> object_passes; ///< that were needed so far
  bool is_worn = false; ///< its passes hold the memory that they took for a large module

  /// The passes for the level that the machine is set to.
  ObjectPasses& passes();
};

struct Target {
  std::shared_ptr<Machine> kept; ///< nobody else's meanwhile
  llvm::TargetMachine* machine = nullptr;
  std::string cpu;
  std::string features;
  unsigned vector_bits = 128; ///< of the widest registers that are worth using
  bool native = false;        ///< code for it runs here
  std::string error;          ///< set where there is no such machine
};

Target make_target(const TargetOptions& options);

/// Whether the processor has a feature of this name of LLVM's.
bool has_feature(const Target& target, std::string_view feature);

/// Whether code for a processor of this name (NativeExports::processor) runs on the target.
bool runs_code_of(const Target& target, std::string_view processor);

/// The lane count of one machine vector of the precision's numbers. (What code is made for is choose_width's.)
unsigned best_width(const Target& target, Precision precision);
/// The same for this machine.
unsigned native_width(Precision precision);

} // namespace moonshade::codegen
