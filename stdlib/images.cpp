#include "stdlib/images.h"

namespace moonshade {

const LibraryFunction& texture_row() {
  static const LibraryFunction row = [] {
    LibraryFunction made = {};
    made.name = made.symbol = "texture";
    made.parameter_count = made.required_count = 3;
    made.result_count = 1;
    made.parameters = {ValueType::Integer, ValueType::Vec2, ValueType::Number};
    made.results[0] = ValueType::Vec4;
    made.parameter_names = "image uv width";
    return made;
  }();
  return row;
}

const LibraryDerivative& texture_derivative() {
  static const LibraryDerivative derivative = [] {
    constexpr unsigned kUv = 1u << 1;
    LibraryDerivative made = {texture_row(), &texture_row(), kUv, {}};
    made.function.name = "derivative of texture";
    made.function.symbol = "texture__uv";
    made.function.result_count = 3;
    for (unsigned column = 0; column < 2; ++column) {
      made.function.results[1 + column] = ValueType::Vec4;
      made.used[made.index(column, 0)] = 0b1111;
    }
    return made;
  }();
  return derivative;
}

bool is_texture(const LibraryFunction& row) { return &row == &texture_row() || &row == &texture_derivative().function; }

} // namespace moonshade
