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

/// The type of a variable as far as it is inferred, and what made it so.
struct Variable {
  Type type;
  Type first_type; ///< of the first value given to it, and where
  Span first{};
  /// The first value that did not fit. Kept, for where the value depends on the variable itself the conflict is not met
  /// again: by then the variable's type is the conflicting one.
  Type conflict_type;
  Span conflict{};
  const syntax::Expr* integer_given = nullptr; ///< an integer given to it, for `mixed-number`
};

struct Global {
  std::string_view name;
  /// The function that it stands for; null for a variable.
  const syntax::Function* function = nullptr;
  Span definition{};      ///< the first one
  bool is_used = false;   ///< some expression names it
  bool in_branch = false; ///< the first definition stands in a branch or a loop
  bool is_broken = false; ///< a function, but defined several times or in a branch: stands for nothing
  Variable variable;      ///< of a variable
  uint32_t slot = ~0u;    ///< of a variable: index in Program::globals
};

struct Globals {
  std::unordered_map<std::string_view, Global> by_name;
  /// Those that stand for functions, in the order of their definitions.
  std::vector<Global*> functions;
  /// Names that only functions assign, which is refused there.
  std::set<std::string_view> assigned_inside;
  /// Locals declared without a value and assigned once, in the block of the declaration: such a one may stand for a
  /// function (`local f ... function f() end`), which then captures nothing that lives shorter than the name.
  std::set<const syntax::Local*> assigned_once;

  Global* find(std::string_view name) {
    const auto found = by_name.find(name);
    return found == by_name.end() ? nullptr : &found->second;
  }
};

/// Globals that stand for a function but are defined more than once, or only on some paths, are marked as broken; the
/// walk refuses their definitions.
Globals collect_globals(const syntax::Chunk& chunk);

} // namespace moonshade::sema
