// What is no error but probably not meant: locals and functions without a use, library names hidden and then called,
// loops that end only on the exact equality of numbers, statements that nothing reaches. Names that begin with `_` are
// never warned of. A look over the syntax once, after a check without errors.
#pragma once

#include "compiler/base/diagnostics.h"
#include "compiler/sema/program.h"

namespace moonshade::sema {

/// Warns of one file of the program.
void check_warnings(const syntax::Chunk& chunk, const Program& program, Diagnostics& diagnostics);

} // namespace moonshade::sema
