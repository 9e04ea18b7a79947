// Which expressions are integers that stock Lua knows while it compiles: literals, arithmetic on such, and `<const>`
// locals given one. Lua compiles some operations with them otherwise (lcode.c), which can be told from the result.
#pragma once

#include "compiler/syntax/ast.h"

#include <cstdint>
#include <optional>

namespace moonshade::syntax {

std::optional<int64_t> folded_integer(const Expr& expr);

} // namespace moonshade::syntax
