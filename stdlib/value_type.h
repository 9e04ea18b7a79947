// The value types of the dialect, shared by the library's table, the compiler and the runtime.
// Vectors and matrices have number components; a matrix is a row of column vectors.
#pragma once

#include <cstdint>
#include <string_view>

namespace moonshade {

enum class ValueType : uint8_t { Boolean, Integer, Number, Vec2, Vec3, Vec4, Mat3, Mat4 };

/// How many scalars a value of this type is made of: 1, 2, 3, 4, 9 or 16.
constexpr unsigned component_count(ValueType type) {
  switch (type) {
  case ValueType::Vec2:
    return 2;
  case ValueType::Vec3:
    return 3;
  case ValueType::Vec4:
    return 4;
  case ValueType::Mat3:
    return 9;
  case ValueType::Mat4:
    return 16;
  default:
    return 1;
  }
}

constexpr bool is_vector(ValueType type) {
  return type == ValueType::Vec2 || type == ValueType::Vec3 || type == ValueType::Vec4;
}

constexpr bool is_matrix(ValueType type) { return type == ValueType::Mat3 || type == ValueType::Mat4; }

/// The vector type of `size` components, 2 to 4.
constexpr ValueType vector_type(unsigned size) {
  return size == 2 ? ValueType::Vec2 : size == 3 ? ValueType::Vec3 : ValueType::Vec4;
}

/// The matrix type of `size` columns, 3 or 4.
constexpr ValueType matrix_type(unsigned size) { return size == 3 ? ValueType::Mat3 : ValueType::Mat4; }

/// How many columns a matrix has, and components each of them.
constexpr unsigned matrix_size(ValueType type) { return type == ValueType::Mat3 ? 3 : 4; }

/// The type's name as the language's manual and messages write it.
constexpr std::string_view name_of(ValueType type) {
  switch (type) {
  case ValueType::Boolean:
    return "boolean";
  case ValueType::Integer:
    return "integer";
  case ValueType::Number:
    return "number";
  case ValueType::Vec2:
    return "vec2";
  case ValueType::Vec3:
    return "vec3";
  case ValueType::Vec4:
    return "vec4";
  case ValueType::Mat3:
    return "mat3";
  case ValueType::Mat4:
    return "mat4";
  }
  return "?";
}

} // namespace moonshade
