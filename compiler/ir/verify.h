// The verifier: whether a module keeps the rules in ir.h. Run after `build` and, in debug builds, after every pass.
#pragma once

#include "compiler/ir/ir.h"

#include <string>
#include <vector>

namespace moonshade::ir {

/// Every violation, as "function: what is wrong". Empty: the module is sound.
std::vector<std::string> verify(const Module& module);

} // namespace moonshade::ir
