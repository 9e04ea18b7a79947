// What shaderc does with a file beyond checking it. Each prints what is wrong and gives the exit status.
#pragma once

#include "tools/shaderc/options.h"

namespace moonshade::shaderc {

/// --emit
int emit_stage(const CheckedShader& shader, const Options& options);
/// --emit=luals
int emit_luals(const Options& options);
/// --run
int run_shader(const CheckedShader& shader, const Options& options);

} // namespace moonshade::shaderc
