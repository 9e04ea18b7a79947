// The files that a shader requires: found and parsed by the host's loader, each once, in the order in which they run.
#pragma once

#include "compiler/sema/context.h"

namespace moonshade::sema {

/// Modules of a shader, and how deep they may require each other.
inline constexpr size_t kMaxModules = 256;

/// Collects the globals of the shader's file and of all modules, and loads these. What cannot be loaded, or closes a
/// circle, is reported at the `require`.
void collect_modules(Context& context, const Options& options);

/// After the reporting walk: refuses modules that use what other files change, and run in stock Lua nobody knows when.
void check_modules(Context& context);

/// The name in a call of `require`; empty where it is no constant or no name of a module.
std::string_view module_name(const syntax::CallExpr& call);

/// Id of the call that runs module `index`, among the calls of the file that requires it first: no expression has it.
inline uint32_t module_call(size_t index) { return ~static_cast<uint32_t>(index); }

} // namespace moonshade::sema
