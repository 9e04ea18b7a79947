// Integers that fit in 32 bits: half as many registers where lanes hold them.
#pragma once

#include "compiler/ir/ir.h"

#include <vector>

namespace moonshade::ir {

/// By VariableId: whether a variable of type integer always holds a value of 32 bits, given that no point takes more
/// than `step_limit` steps. True of what only counts: all its stores are of small constants, of itself, or of itself
/// and a small constant (or of a choice between these). Each store runs once a step at most, so the counts cannot add
/// up to more.
std::vector<bool> narrow_variables(const Function& function, uint64_t step_limit);

} // namespace moonshade::ir
