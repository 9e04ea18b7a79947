// LuaLS annotations in the comments above a statement: `---@param x vec3`, `---@return number`, `---@type vec3`. They
// state types, and are checked against the inferred ones. What they say beyond the dialect's types (`any`, `fun(...)`,
// classes, arrays, unions with such) is left alone.
#pragma once

#include "compiler/sema/context.h"

#include <string_view>
#include <vector>

namespace moonshade::sema {

struct AnnotatedType {
  std::string_view text; ///< "vec3", "integer|number", "vec3?"
  Span span;
};

/// One comment line.
struct Annotation {
  enum class Kind : uint8_t { Param, Return, Type } kind;
  std::string_view name; ///< of a parameter
  Span name_span{};
  std::vector<AnnotatedType> types; ///< of Param one
};

/// The annotation in a comment; nothing where it has none of these.
std::optional<Annotation> read_annotation(const syntax::Comment& comment);

/// Reports where an annotation and the inferred types of some specialisation differ: after a check without errors.
void check_annotations(Context& context);

} // namespace moonshade::sema
