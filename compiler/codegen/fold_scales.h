// After optimisation: integers that were scaled by a power of two, and are multiplied by constants then.
#pragma once

#include <llvm/IR/Module.h>

namespace moonshade::codegen {

/// Multiplies constants by the power of two instead of the number: hash(p) is an integer below 2^24 times 2^-24, and
/// mix(a, b, hash(p)) multiplies it by six constants. Both products are of the same numbers, so the same is rounded;
/// one multiplication less is waited for.
void fold_scales(llvm::Module& module);

} // namespace moonshade::codegen
