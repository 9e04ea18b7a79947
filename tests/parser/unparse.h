// Writes a tree as Lua again: every operation in parentheses, every local under a name that only it has. Compiled by
// the reference implementation it must give the same code as the text that the tree was parsed from, which shows that
// the parser groups operators, resolves names and reads literals as that does.
#pragma once

#include "compiler/syntax/ast.h"

#include <string>

namespace moonshade::test {

/// On one line. The tree must be without errors.
std::string unparse(const syntax::Chunk& chunk);

} // namespace moonshade::test
