// Which row of the library's table a call means.
#pragma once

#include "compiler/sema/types.h"

#include <span>

namespace moonshade::sema {

/// The row for these argument types: first one that takes them as they are, then one that takes integers as numbers,
/// then one that works by component. Null where there is none.
struct LibraryChoice {
  const LibraryFunction* row = nullptr;
  /// Of a row by component: the vector type of the call.
  std::optional<ValueType> by_component;
  /// The results are numbers that Lua may hold as integers: some argument is mixed, and were it an integer, another
  /// row, with integer results, would be meant.
  bool is_mixed = false;
  /// As is_mixed, but that row gives something else than this one (`hash`): the call cannot be compiled.
  bool depends_on_kind = false;
};
LibraryChoice choose_row(std::span<const LibraryFunction> rows, const std::vector<Type>& types);

/// Why no row fits.
struct LibraryMisfit {
  enum class Kind : uint8_t { TooFew, TooMany, Argument, Sizes } kind = Kind::Argument;
  size_t argument = 0;  ///< which (from 0): wrong, missing, or the first superfluous one
  std::string expected; ///< Argument: "a number", "a vec2 or a vec3"
  size_t most = 0;      ///< TooMany
  std::string name;     ///< TooFew: the parameter
};
LibraryMisfit explain_misfit(std::span<const LibraryFunction> rows, const std::vector<Type>& types);

} // namespace moonshade::sema
