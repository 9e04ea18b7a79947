// Calls of the library's machine code (native_library.h) in place of its bitcode. A call goes by the export's own
// convention, through pointers; what it costs is that and registers kept in memory meanwhile, a few nanoseconds for a
// block of lanes.
#pragma once

#include "compiler/codegen/codegen.h"
#include "compiler/codegen/target.h"

#include <llvm/IR/Module.h>

#include <string_view>

namespace moonshade::codegen {

/// Whether the domain's exports, for all lanes and for one, can be called on the target.
bool has_native_calls(const Target& target, Precision precision, unsigned width);

/// Renames the declarations of exports that are to be called, so that the library's bitcode does not define them.
void choose_native_calls(llvm::Module& module, const Target& target, LibraryCalls calls);

/// Where the function of such a name lies; null where there is none.
const void* native_call_address(std::string_view name);

} // namespace moonshade::codegen
