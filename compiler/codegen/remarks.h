// What the compiler decided about lanes, for people who want to know where the time goes: `shaderc --remarks`.
#pragma once

#include "compiler/base/diagnostics.h"
#include "compiler/codegen/codegen.h"

#include <string>

namespace moonshade::codegen {

/// Reports the width, branches and loops that divide the lanes, gathers and scatters, functions that are called rather
/// than inlined, and places where steps are counted, as notes at their places. Gives the error: an unknown CPU or
/// target.
std::string report_remarks(const ir::Module& module, const Options& options, Diagnostics& diagnostics);

} // namespace moonshade::codegen
