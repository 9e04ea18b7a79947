// What the generator knows of the program that it writes: types, shapes of tables, what functions take, give and
// assign.
#pragma once

#include <climits>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace moonshade::oracle {

enum class T : uint8_t { B, I, N, V2, V3, V4, M3, M4 };

constexpr bool is_vector(T type) { return type >= T::V2 && type <= T::V4; }
constexpr bool is_matrix(T type) { return type >= T::M3; }
constexpr unsigned size_of(T type) { return type == T::V2 ? 2 : type == T::V3 || type == T::M3 ? 3 : 4; }
constexpr unsigned bit(T type) { return 1u << static_cast<unsigned>(type); }

struct Shape;

/// A value's, or a table's of a shape.
struct Type {
  T base = T::N;
  const Shape* shape = nullptr;
};

/// An array of `length`, or a record of fields.
struct Shape {
  struct Field {
    std::string name;
    Type type;
  };
  int length = 0;
  Type element;
  std::vector<Field> fields;
  unsigned leaves = 0; ///< bits of the types of values anywhere in it
  bool is_array() const { return length > 0; }
};

struct Variable {
  std::string name;
  T type;
  bool assignable;
  int level;     ///< how many functions are around its declaration
  int bound = 0; ///< it is known to lie in 1..bound, where that is not 0
};

struct TableVariable {
  std::string name;
  const Shape* shape;
  int level;               ///< of what it refers to
  bool writable;           ///< by those that its level lets write
  bool is_own;             ///< made for this name, so that it may become a field of a record
  int parameter = -1;      ///< the function's at `level` that it is
  bool is_element = false; ///< it may be an element of an array, which cannot be a result
};

constexpr int kNoEffect = INT_MAX;
/// Of a closure that assigns what its maker declared, and no more: the level is that of the instance.
constexpr int kOwnState = INT_MAX - 1;

struct Function;

struct Parameter {
  Type type;
  /// A function of this signature: types of arguments, then of the result.
  std::vector<T> signature;
  bool is_mutated = false; ///< a table that the function writes to
};

struct Function {
  std::string name;
  std::vector<Parameter> parameters;
  const Shape* table = nullptr; ///< the first result: a fresh table
  int same = -1;                ///< the first result: the table that this parameter is
  std::vector<T> results;       ///< those after it
  /// The least level of what a call assigns. Such calls stand as statements of their own.
  int effect = kNoEffect;
  /// The result is a closure, or a record of closures (`fields`) and a number `k`.
  std::shared_ptr<Function> closure;
  std::vector<Function> fields;
};

} // namespace moonshade::oracle
