// The optimiser's passes for a module: few, because what comes in is small and the library's part is optimised already.
#pragma once

#include <llvm/IR/Module.h>
#include <llvm/Target/TargetMachine.h>

namespace moonshade::codegen {

/// Instead of a level: nothing but inlining, for functions that make other passes take quadratic time.
inline constexpr int kInlineOnly = -1;

/// `level` as in -O0 to -O3.
void optimize(llvm::Module& module, llvm::TargetMachine& machine, int level);

/// Whether the module is well-formed; the first complaint otherwise.
std::string verify(const llvm::Module& module);

} // namespace moonshade::codegen
