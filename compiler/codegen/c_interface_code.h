// The functions and tables of a shader's interface for C, added to the module of its code.
#pragma once

#include "compiler/codegen/c_interface.h"
#include "compiler/codegen/emitter.h"

namespace moonshade::codegen {

/// `module` holds the finished code. Afterwards the interface's functions and its table of sites are all that other
/// objects can see of it. Gives the error, or an empty text.
std::string add_c_interface(llvm::Module& module, const CInterface& interface, const CodeInfo& code,
                            const FunctionAttributes& attributes);

} // namespace moonshade::codegen
