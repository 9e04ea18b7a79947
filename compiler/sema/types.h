// Types and what can be asked of them: how they join, whether they are numbers, how messages call them.
#pragma once

#include "compiler/sema/program.h"

#include <optional>
#include <string>
#include <vector>

namespace moonshade::sema {

inline Type unknown_type() { return {}; }
inline Type number_type() { return Type::of(ValueType::Number); }
inline Type integer_type() { return Type::of(ValueType::Integer); }
inline Type boolean_type() { return Type::of(ValueType::Boolean); }
inline Type type_of_kind(Type::Kind kind) {
  Type type;
  type.kind = kind;
  return type;
}
inline Type none_type() { return type_of_kind(Type::Kind::None); }
inline Type mixed_type() {
  Type type = number_type();
  type.mixed = true;
  return type;
}
inline Type string_type(std::string_view text) {
  Type type = type_of_kind(Type::Kind::String);
  type.text = text;
  return type;
}
inline Type library_type(std::string_view name) {
  Type type = type_of_kind(Type::Kind::Library);
  type.text = name;
  return type;
}
inline Type function_type(const syntax::Function* function, Work* frame) {
  Type type = type_of_kind(Type::Kind::Function);
  type.function = function;
  type.frame = frame;
  return type;
}
inline Type table_type(Table* table) {
  Type type = type_of_kind(Type::Kind::Table);
  type.table = table;
  return type;
}

inline bool is_unknown(const Type& type) { return type.kind == Type::Kind::Unknown; }
/// An integer or a number.
inline bool is_scalar(const Type& type) { return type.is(ValueType::Integer) || type.is(ValueType::Number); }
/// A function of the shader or of the library (or one of its tables).
inline bool is_function(const Type& type) {
  return type.kind == Type::Kind::Function || type.kind == Type::Kind::Library;
}
inline bool is_table(const Type& type) { return type.kind == Type::Kind::Table; }
/// What can be an operand, a parameter or a variable at run time, functions and constants left aside.
inline bool has_storage(const Type& type) { return type.is_value() || (is_table(type) && type.table->is_element()); }
inline bool is_vector(const Type& type) { return type.is_value() && is_vector(type.value); }

inline bool is_matrix(const Type& type) { return type.is_value() && is_matrix(type.value); }

/// Of what was given values of types that do not fit each other, which is reported once: it agrees with everything, so
/// that nothing follows from it.
inline Type conflicting_type() {
  Type type;
  type.mixed = true;
  return type;
}

/// The least type that holds both: integer and number give a mixed number, Unknown agrees with everything. Nothing
/// where there is none.
std::optional<Type> join(const Type& a, const Type& b);

/// As messages write it, with an article: "a number", "an integer", "a vec3", "a function".
std::string describe(const Type& type);
/// The bare name, for signatures: "vec3", "number".
std::string type_name(const Type& type);

/// The values of an expression list. `open`: how many there are is not known (an error, or not inferred yet).
struct TypeList {
  std::vector<Type> types;
  bool open = false;

  /// The value at `index`: Unknown beyond an open end, None beyond a closed one.
  Type at(size_t index) const {
    if (index < types.size()) return types[index];
    return open ? unknown_type() : none_type();
  }
};

/// For hash tables keyed by types.
size_t hash_of(const Type& type);

} // namespace moonshade::sema
