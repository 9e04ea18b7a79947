// The parser: all of Lua 5.4 (5.4.4), as the reference implementation takes it, into an AST. It resolves scopes as
// lparser.c does and refuses what lparser.c refuses beyond the grammar (break outside a loop, goto into a scope,
// assignment to constants, ...). After an error it goes on at the next statement, so that each independent error is
// reported once; an error stands at the first byte of the token at which parsing cannot go on.
#pragma once

#include "compiler/base/arena.h"
#include "compiler/base/diagnostics.h"
#include "compiler/base/source.h"
#include "compiler/syntax/ast.h"

#include <cstddef>

namespace moonshade::syntax {

// Limits of our own, beyond which `too-large` is reported and parsing ends. The reference implementation has others
// (200 levels of its C stack, 200 locals and 255 upvalues a function).

/// Bytes of a source text: 16 MiB.
inline constexpr size_t kMaxSourceBytes = size_t{16} << 20;
/// Statements and expressions inside each other, as the parser recurses: a bracket, a block, a unary or a
/// right-associative operator counts one; a function that stands in a statement of its own counts two.
/// The parser needs less than 512 KB of stack for them (in a release build).
inline constexpr unsigned kMaxNesting = 400;
/// Levels of the whole tree: nesting (a block and its statement are two), and chains like a + b + c or a.b.c, each link
/// of which is a level. A recursive visitor of two frames of 500 bytes a level needs 1 MB for it.
inline constexpr unsigned kMaxTreeHeight = 1000;

/// Parses a file of the set. Never null: what could not be parsed is an error node, and `diagnostics.has_errors()`
/// tells. The tree lives in `arena` and refers to the text in `sources`.
Chunk* parse(SourceSet& sources, FileId file, Arena& arena, Diagnostics& diagnostics);

} // namespace moonshade::syntax
