// After optimisation: values of several machine registers become values of one, each with code of its own.
#pragma once

#include <llvm/IR/Module.h>

namespace moonshade::codegen {

/// Splits what works on `lanes` lanes into halves, and these again, until a value has at most `register_lanes`. LLVM
/// would split numbers as well, but keeps a mask of all lanes in one register: it is put together from comparisons of
/// the halves and taken apart again for their selections.
void split_lanes(llvm::Module& module, unsigned lanes, unsigned register_lanes);

} // namespace moonshade::codegen
