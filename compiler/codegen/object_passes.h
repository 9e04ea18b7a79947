// From a module to the bytes of an object file.
#pragma once

#include <llvm/ADT/SmallString.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Target/TargetMachine.h>

#include <string>

namespace moonshade::codegen {

/// LLVM's passes to an object file, for the level that the machine is set to. Choosing and arranging them takes as long
/// as most of them take together on a small function, so they are for any number of modules, one after the other.
class ObjectPasses {
public:
  explicit ObjectPasses(llvm::TargetMachine& machine)
      : cannot_emit_(machine.addPassesToEmitFile(passes_, stream_, nullptr, llvm::CodeGenFileType::ObjectFile)) {}

  /// There are no object files of this target.
  bool cannot_emit() const { return cannot_emit_; }

  std::string run(llvm::Module& module) {
    bytes_.clear();
    passes_.run(module);
    return std::string(bytes_);
  }

private:
  llvm::SmallString<0> bytes_;
  llvm::raw_svector_ostream stream_{bytes_};
  llvm::legacy::PassManager passes_;
  const bool cannot_emit_; // the last, for it needs the others
};

} // namespace moonshade::codegen
