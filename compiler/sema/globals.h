// Facts about names from one look over the syntax, above all the global variables of a shader: who defines them, where,
// and whether anything uses them. A global that is defined once, by a function at the top level, stands for that
// function; any other is a variable.
#pragma once

#include "compiler/sema/types.h"

#include <set>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace moonshade::sema {

struct Global {
  std::string_view name;
  /// The function that it stands for; null for a variable.
  const syntax::Function* function = nullptr;
  Span definition{};      ///< the first one
  bool is_used = false;   ///< some expression names it
  bool in_branch = false; ///< the first definition stands in a branch or a loop
  bool is_broken = false; ///< a function, but defined several times or in a branch: stands for nothing
  bool is_single = true;  ///< nothing but the first definition assigns it
  /// Where in its file it may have its value from: behind the first definition, or where the loop around that begins.
  uint32_t begins = 0;
  Variable variable; ///< of a variable
};

struct Globals {
  std::unordered_map<std::string_view, Global> by_name;
  /// Those that stand for functions, in the order of their definitions.
  std::vector<Global*> functions;
  /// Names that only functions assign, which is refused there.
  std::set<std::string_view> assigned_inside;
  /// Locals declared without a value and assigned once, in the block of the declaration or in a `do` within: such a one
  /// may stand for a function (`local f ... function f() end`), which then captures nothing that lives shorter than the
  /// name, for its block runs as often as that.
  std::set<const syntax::Local*> assigned_once;
  /// Those that are assigned in branches of `if`s alone, of which at most one is taken: such a one may stand for a
  /// table that is built in each.
  std::set<const syntax::Local*> assigned_in_branches;

  Global* find(std::string_view name) {
    const auto found = by_name.find(name);
    return found == by_name.end() ? nullptr : &found->second;
  }
};

/// A call of `require`; a certain one is reached whatever happens.
struct RequireCall {
  const syntax::CallExpr* call = nullptr;
  /// The statement in which it stands that is reached whatever happens: the nearest, or the last such one before a
  /// jump.
  const syntax::Stat* stat = nullptr;
  bool is_certain = false;
};

/// Globals that stand for a function but are defined more than once, or only on some paths, are marked as broken; the
/// walk refuses their definitions.
/// `calls` gets the calls of `require` in the chunk, in order.
void collect_globals(const syntax::Chunk& chunk, Globals& globals, std::vector<RequireCall>& calls);

} // namespace moonshade::sema
