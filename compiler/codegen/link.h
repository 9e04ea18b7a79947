// Brings the library's functions in use into a module: from the embedded bitcode, of which only what is needed is read.
#pragma once

#include "compiler/codegen/emitter.h"
#include "compiler/codegen/library_context.h"

namespace moonshade::codegen {

/// Links the exports of `domain` (and those for one lane) that the module calls; they become internal. `error` is set
/// where one does not exist.
void link_library(llvm::Module& module, LibraryContext& library, const Domain& domain,
                  const FunctionAttributes& attributes, std::string& error);

} // namespace moonshade::codegen
