// The answers that the library asks of the code generator: whether the processor has tables in vector registers, and
// the look-ups in them (stdlib/tables.h).
#pragma once

#include "compiler/codegen/target.h"

#include <llvm/IR/Module.h>

namespace moonshade::codegen {

/// Whether the processor has them.
bool has_tables(const Target& target);

/// For a module that the library is linked into: gives the weak functions of stdlib/gather.ll.in their bodies.
void define_tables(llvm::Module& module, const Target& target);

} // namespace moonshade::codegen
