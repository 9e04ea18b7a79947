// --compile-times: how long shaders take to become code.
#pragma once

#include "tools/moonbench/options.h"

namespace moonshade::moonbench {

/// Measures every entry of the files and prints a table in Markdown, or JSON; gives the exit status.
int report_compile_times(const Options& options);

} // namespace moonshade::moonbench
