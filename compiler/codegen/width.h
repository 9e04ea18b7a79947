// How many lanes code is made for, where nobody says.
#pragma once

#include "compiler/codegen/codegen.h"
#include "compiler/codegen/target.h"

namespace moonshade::codegen {

struct WidthChoice {
  unsigned width;
  const char* why; ///< for remarks
};

/// As asked; else one machine vector of the precision's numbers, or two of them where that pays: on code short enough
/// that its chains of operations, not its number, take the time.
WidthChoice choose_width(const ir::Module& module, const Target& target, const Options& options);

} // namespace moonshade::codegen
