// The lattice of types is flat but for integer <: mixed number and number <: mixed number, so a variable's type can
// change at most three times (unknown, integer, mixed, conflicting) and inference ends.
#include "compiler/sema/types.h"

#include <functional>

namespace moonshade::sema {

std::optional<Type> join(const Type& a, const Type& b) {
  if (b == conflicting_type()) return b;
  if (a == b || is_unknown(b) || a == conflicting_type()) return a;
  if (is_unknown(a)) return b;
  if (is_scalar(a) && is_scalar(b)) return mixed_type();
  return std::nullopt;
}

std::string describe(const Type& type) {
  switch (type.kind) {
  case Type::Kind::Unknown:
    return "an unknown value";
  case Type::Kind::None:
    return "no value";
  case Type::Kind::Value:
    return (type.is(ValueType::Integer) ? "an " : "a ") + std::string(name_of(type.value));
  case Type::Kind::String:
    return "a string";
  case Type::Kind::Function:
    return "a function";
  case Type::Kind::Table:
    return type.table->kind == Table::Kind::Array ? "an array" : "a record";
  case Type::Kind::Library:
    return type.text == "math" ? "a table of the library" : "the library's function '" + std::string(type.text) + "'";
  }
  return "?";
}

std::string type_name(const Type& type) {
  switch (type.kind) {
  case Type::Kind::Unknown:
    return "?";
  case Type::Kind::None:
    return "nothing";
  case Type::Kind::Value:
    return std::string(name_of(type.value));
  case Type::Kind::String:
    return "string";
  case Type::Kind::Table:
    return type.table->kind == Table::Kind::Array ? "array" : "record";
  case Type::Kind::Function:
  case Type::Kind::Library:
    return "function";
  }
  return "?";
}

size_t hash_of(const Type& type) {
  size_t hash = static_cast<size_t>(type.kind) * 31 + static_cast<size_t>(type.value) * 2 + (type.mixed ? 1 : 0);
  hash = hash * 1000003 + std::hash<const void*>()(type.function);
  hash = hash * 1000003 + std::hash<const void*>()(type.frame);
  hash = hash * 1000003 + std::hash<const void*>()(type.table);
  return hash * 1000003 + std::hash<std::string_view>()(type.text);
}

} // namespace moonshade::sema
