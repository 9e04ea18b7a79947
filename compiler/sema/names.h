// What a global name stands for where the shader itself does not define it, and the nearest known name for one that is
// unknown.
#pragma once

#include "compiler/base/diagnostics.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::sema {

/// A name of Lua or of the library that is refused: with which code and which words.
struct RefusedName {
  std::string_view name;
  DiagnosticCode code;
  /// The second part of the message where it has one ("{1}"); for NotAvailableYet the whole subject.
  std::string_view advice;
};

/// Lua's global functions and tables that the dialect leaves out, functions of the library that are planned, and
/// "math.random", "math.randomseed"; null for any other name.
const RefusedName* find_refused_name(std::string_view name);

/// vec2, param, assert, ...: functions that are known to the compiler itself, not to the library's table.
bool is_built_in(std::string_view name);

/// Is `name` ("noise", "math.sin") a function that may be called? "math" itself is a table, not a function.
bool is_library_function(std::string_view name);

/// The same name in static storage, for types to point at; `name` must be a library function.
std::string_view permanent_library_name(std::string_view name);

/// math.pi, math.huge, math.maxinteger, math.mininteger.
struct LibraryConstant {
  std::string_view name;
  bool is_integer;
  double number;
  int64_t integer;
};
const LibraryConstant* find_library_constant(std::string_view name);

/// The names after `prefix` ("math.") of all that the library has; without prefix the global names.
std::vector<std::string_view> library_names(std::string_view prefix);

/// The candidate that `name` was probably meant to be: the fewest edits, at most a third of its length.
std::optional<std::string_view> nearest(std::string_view name, std::span<const std::string_view> candidates);

/// "; did you mean 'x'" for messages, or nothing.
std::string suggestion(const std::optional<std::string_view>& nearest_name);
/// The name as the fix of the diagnostic, where there is one.
void suggest_fix(Diagnostic& diagnostic, const std::optional<std::string_view>& nearest_name);

} // namespace moonshade::sema
