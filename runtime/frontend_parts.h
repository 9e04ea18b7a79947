// What a checked shader consists of, for the runtime's own files.
#pragma once

#include "compiler/base/arena.h"
#include "compiler/codegen/codegen.h"
#include "compiler/ir/build.h"
#include "compiler/ir/passes.h"
#include "compiler/sema/program.h"
#include "compiler/syntax/parser.h"
#include "runtime/frontend.h"

namespace moonshade {

struct CheckedShader::Parts {
  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  syntax::Chunk* chunk = nullptr;
  struct Module {
    std::string name;
    syntax::Chunk* chunk;
  };
  std::vector<Module> modules;      ///< that the shader requires, in the order of their loading
  syntax::Chunk* library = nullptr; ///< the library's own Lua, where the shader calls some of it
  sema::Program program;
  double parse_milliseconds = 0, sema_milliseconds = 0;
};

/// The optimised IR of the entries that the options ask for.
ir::Module build_module(const CheckedShader& shader, const CompileOptions& options);
/// The same before it is optimised, with its prints.
ir::Module build_printing_module(const CheckedShader& shader, const CompileOptions& options);
/// The shader's facts, with the entries of the module, in its order.
ShaderInfo compiled_info(const ShaderInfo& info, const ir::Module& module, const CompileOptions& options);
/// A fault site's place in the source.
FaultSite resolve(const SourceSet& sources, const codegen::FaultPlaceInfo& place);
codegen::Options codegen_options(const CompileOptions& options);

} // namespace moonshade
