// For tests: shaders from source text, executed as IR and by stock Lua.
#pragma once

#include "compiler/base/arena.h"
#include "compiler/base/diagnostics.h"
#include "compiler/ir/build.h"
#include "compiler/ir/test_interpreter.h"
#include "compiler/sema/program.h"

#include <memory>
#include <string>
#include <vector>

namespace moonshade::ir::test {

/// A checked shader.
struct Checked {
  std::unique_ptr<SourceSet> sources;
  std::unique_ptr<Arena> arena;
  std::unique_ptr<Diagnostics> diagnostics;
  sema::Program program;
  std::string errors; ///< as text; empty where there are none
};
Checked check(const std::string& text);

/// The inputs of an entry at point number `index` of a fixed list.
std::vector<Value> inputs_at(const EntryInfo& entry, unsigned index);
inline constexpr unsigned kPoints = 8;

/// The default values of the parameters.
std::vector<Value> parameters_of(const ShaderInfo& info);

/// What stock Lua beside the library's module gives: results as to_text, or "fault" where it raises an error.
std::string run_lua(const std::string& text, const std::string& entry, const std::vector<Value>& arguments);

} // namespace moonshade::ir::test
