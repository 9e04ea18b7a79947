// Invariants of every tree that the parser makes, whatever the input.
#pragma once

#include "compiler/syntax/ast.h"

#include <string>

namespace moonshade::test {

/// Says what is wrong with the tree; empty where nothing is. Ids are unique and dense enough, spans lie in their
/// parent's and in the text, heights are right and within the limit, required children are there, and a tree without
/// errors has no error nodes.
std::string check_tree(const syntax::Chunk& chunk, size_t text_size, bool has_errors);

} // namespace moonshade::test
