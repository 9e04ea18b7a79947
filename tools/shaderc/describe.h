// --describe: what a host may know of a shader, as JSON.
#pragma once

#include "compiler/sema/shader_info.h"

#include <string>

namespace moonshade::shaderc {

/// {"file", "entries": [{"name", "inputs": [{"name", "type"}], "results": [type...], "result"}],
///  "parameters": [{"name", "type", "default", and of min, max, step, doc, label, choices those given}],
///  "modules", "images"}. "result" is the type of the only result, and left out where there are none or several.
std::string describe(const std::string& file, const ShaderInfo& info);

} // namespace moonshade::shaderc
