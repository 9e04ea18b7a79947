// Step counting for stock Lua: a text of the same meaning and the same lines in which each step calls a function first.
#pragma once

#include "compiler/syntax/ast.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace moonshade {

enum class CountedSteps : uint8_t {
  All,   ///< loop iterations and calls of functions: the steps of compiled code
  Loops, ///< loop iterations only: enough to end every shader, and free of cost where there is no loop
};

/// The text of `chunk` with a call of the empty string, `("")();`, at the start of each loop body and each function
/// body: the metatable of strings makes it the step function. No name can collide with it, and it needs neither a local
/// nor an upvalue, of which a function has only so many. With CountedSteps::All table constructors become arguments of
/// such a call too, which makes an index outside of the table a fault.
std::string with_counted_steps(const syntax::Chunk& chunk, std::string_view text, CountedSteps steps);

} // namespace moonshade
