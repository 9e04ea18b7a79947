// Where code is generated at level 0: vectors of constants become loads.
#pragma once

#include <llvm/IR/Module.h>

namespace moonshade::codegen {

/// LLVM's selection takes a vector of numbers apart, makes a node of each and combines them again, in each block that
/// uses it, only to load it from memory after all. A load is three nodes, whatever the width.
void load_constants(llvm::Module& module);

} // namespace moonshade::codegen
