// Step counting for stock Lua: a text of the same meaning and the same lines in which each step calls a function first.
#pragma once

#include "compiler/syntax/ast.h"

#include <string>
#include <string_view>

namespace moonshade {

/// The text of `chunk` with a call of the empty string, `("")();`, at the start of each function body and each loop
/// body: the metatable of strings makes it the step function. No name can collide with it, and it needs neither a local
/// nor an upvalue, of which a function has only so many.
std::string with_counted_steps(const syntax::Chunk& chunk, std::string_view text);

} // namespace moonshade
