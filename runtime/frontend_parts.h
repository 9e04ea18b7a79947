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
/// Optimises what build_printing_module gave; with CompileOptions::bake the parameters are constants then. Gives the
/// error of a value that does not fit its parameter.
std::string optimize_module(ir::Module& module, const ShaderInfo& info, const CompileOptions& options);
/// The shader's facts, with the entries of the module, in its order.
ShaderInfo compiled_info(const ShaderInfo& info, const ir::Module& module, const CompileOptions& options);
/// What code generation refused, as a diagnostic of the file where it concerns the shader.
std::string refusal(const CheckedShader& shader, const codegen::Generated& generated, bool color);
/// A fault site's place in the source.
FaultSite resolve(const SourceSet& sources, const codegen::FaultPlaceInfo& place);
codegen::Options codegen_options(const CompileOptions& options);
/// The same for code that runs in this process.
codegen::Options jit_options(const CompileOptions& options);
/// For code that is to be there soon, whatever its speed; of the same bits.
void make_quick(codegen::Options& options);

} // namespace moonshade
