// From a checked program to IR: each specialisation becomes a function, translated by the facts that sema found.
// Nothing is decided here that sema decided, and nothing is optimised but what costs nothing to get right at once.
//
// Specialisation 0, the top level, becomes Module::init. Function i of the module is specialisation i; wrappers of
// entries whose results are converted come after them. Global i is slot i of the program; further parameters come after
// them.
#pragma once

#include "compiler/ir/ir.h"
#include "compiler/sema/program.h"

namespace moonshade::ir {

struct BuildOptions {
  uint64_t step_limit = 1'000'000;
};

/// `program` must come from a check that reported no error.
Module build(const sema::Program& program, const BuildOptions& options = {});

} // namespace moonshade::ir
