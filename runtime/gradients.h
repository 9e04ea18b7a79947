// Entries for gradients (shader.h), for the runtime's own files.
#pragma once

#include "compiler/ir/ir.h"
#include "runtime/shader.h"

namespace moonshade {

/// Adds the entries that the options ask for to a module that was just built.
void add_gradients(ir::Module& module, const ShaderInfo& info, const CompileOptions& options);

/// The entry `name` of the module as its host sees it: the shader's own or a gradient.
EntryInfo entry_info(const std::string& name, const ShaderInfo& info, const CompileOptions& options);

} // namespace moonshade
