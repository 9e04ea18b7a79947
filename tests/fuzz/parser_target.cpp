// The parser: it accepts what the reference implementation accepts, capacity aside; its trees keep their invariants and
// print; what it accepts, written as Lua again, it accepts too.
#include "compiler/syntax/parser.h"

#include "check_tree.h"
#include "lua_verdict.h"
#include "tests/fuzz/target.h"
#include "unparse.h"

#include <algorithm>
#include <sstream>

namespace moonshade {
namespace {

using fuzz::require;
using test::Verdict;

bool is_too_large(const Diagnostics& diagnostics) {
  const auto sorted = diagnostics.sorted();
  return std::any_of(sorted.begin(), sorted.end(),
                     [](const Diagnostic* d) { return d->code == DiagnosticCode::TooLarge; });
}

void check_verdict(std::string_view text, const Diagnostics& diagnostics) {
  const test::Lua::Result lua = test::Lua().load(text);
  if (lua.verdict == Verdict::OutOfCapacity || is_too_large(diagnostics)) return;
  if (lua.verdict == Verdict::Refuses)
    require(diagnostics.has_errors(), "accepted, but the reference implementation says: " + lua.message);
  else if (diagnostics.has_errors())
    fuzz::fail("refused, but the reference implementation accepts it: " + diagnostics.sorted().front()->message);
}

void check_accepted(const syntax::Chunk& chunk) {
  std::ostringstream tree;
  syntax::print_ast(chunk, tree);
  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  const FileId file = sources.add("again", test::unparse(chunk));
  syntax::parse(sources, file, arena, diagnostics);
  // Parentheses around every operation may exceed the nesting that the first text kept to.
  if (diagnostics.has_errors() && !is_too_large(diagnostics))
    fuzz::fail("written again it is refused: " + diagnostics.sorted().front()->message);
}

} // namespace
} // namespace moonshade

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  if (size > fuzz::kMaxInput) return 0;
  const std::string_view text = fuzz::text_of(data, size);
  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  const FileId file = sources.add("fuzz.lua", std::string(text));
  const syntax::Chunk* chunk = syntax::parse(sources, file, arena, diagnostics);
  fuzz::check_diagnostics(diagnostics, sources);
  const std::string fault = test::check_tree(*chunk, size, diagnostics.has_errors());
  fuzz::require(fault.empty(), "the tree breaks an invariant: " + fault);
  check_verdict(text, diagnostics);
  if (!diagnostics.has_errors()) check_accepted(*chunk);
  return 0;
}
