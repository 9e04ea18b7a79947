// The standard library as data: what the compiler, the interpreter's module and the manual know of each function.
// Everything here is generated from table.def; a row that does not fit its C++ function does not compile.
//
// Compiled code calls a function by its export for one number representation and width,
//
//     void ms_<symbol>_<f32|f64>_w<W>(void* result..., const void* argument...)
//
// one pointer a result and then one a parameter, each to `component_count(type)` lane vectors in memory order
// x, y, z, w (matrices column by column); where a row has several results, the pointer to one that nobody uses may be
// null, which can save work. The lane vector of W lanes is, for numbers, W floats or doubles; for
// integers, W int64_t; for booleans, W bytes of 0 or 1; W = 1 is the plain scalar. Vectors are aligned to their size.
// The exports live in bitcode (library_bitcode) and are always inlined, after which nothing of the pointers is left.
// Every function is pure, terminates, and is defined for every bit pattern of its arguments, so it may be called with
// garbage in lanes that are switched off.
#pragma once

#include "stdlib/value_type.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace moonshade {

/// How `number` is represented: `float` or `double`.
enum class Precision : uint8_t { F32, F64 };
constexpr std::string_view name_of(Precision precision) { return precision == Precision::F32 ? "f32" : "f64"; }
/// What the names of a domain's exports end with: "_f32_w16".
inline std::string export_ending(Precision precision, unsigned width) {
  return std::string("_").append(name_of(precision)).append("_w").append(std::to_string(width));
}

/// The lane counts for which code can be made.
inline constexpr std::array<unsigned, 5> kWidths = {1, 4, 8, 16, 32};

/// One overload of a function of the library.
struct LibraryFunction {
  static constexpr unsigned kMaxParameters = 8;
  static constexpr unsigned kMaxResults = 128; ///< of second derivatives; the rows themselves have fewer

  /// As Lua writes it: "noise", "math.sin". Operators that are more than one instruction begin with "op.": "op.mod".
  std::string_view name;
  /// The middle of the exports' names; unique in the table.
  std::string_view symbol;
  uint8_t parameter_count;
  /// Parameters without a default; those after them may be left out and are then `defaults[index]`.
  uint8_t required_count;
  uint8_t result_count;
  /// A function of numbers that also takes vectors, by component; a number beside a vector counts for each component.
  bool componentwise;
  std::array<ValueType, kMaxParameters> parameters;
  std::array<ValueType, kMaxResults> results;
  std::array<double, kMaxParameters> defaults;
  /// Parameter names, separated by blanks, and one line of documentation.
  std::string_view parameter_names;
  std::string_view doc;
};

/// The whole library; overloads of one name stand side by side, in the order in which they are tried.
std::span<const LibraryFunction> library();

/// The overloads of `name`; empty where the library has no such function.
std::span<const LibraryFunction> library_overloads(std::string_view name);

/// A row's derivative as a function of its own: the row's parameters; results are the row's results and, for each
/// component of the parameters that it differentiates by, in order, each result's derivative by that component (of the
/// result's type; of an integer or boolean 0). Its exports are of their own too (derivative_bitcode). A componentwise
/// row's is for numbers.
struct LibraryDerivative {
  LibraryFunction function;
  const LibraryFunction* row;
  /// A bit for each parameter, the first in the lowest.
  unsigned parameters;
  /// By component of those parameters and result (`index`): a bit for each component of the result that can depend on
  /// it.
  std::array<uint16_t, LibraryFunction::kMaxResults> used;

  /// The place in `used` of one result's derivative by one component; in the function's results that of the value's
  /// results is before them.
  unsigned index(unsigned column, unsigned result) const { return column * row->result_count + result; }
};

/// All of them. The first call makes the table.
std::span<const LibraryDerivative> library_derivatives();

/// The cheapest derivative of `row` by at least those of `parameters` by which it is not zero everywhere; null where it
/// is. (dual.h states what derivatives are at kinks.)
const LibraryDerivative* library_derivative(const LibraryFunction& row, unsigned parameters);

/// A derivative to the second order, by the same parameters, which have C components together. Its results are lists
/// of what the row gives, an integer or boolean as the number 0: the values; their derivatives by each component (the
/// columns); and for each pair j <= k of columns, in the order (0, 0), (0, 1), ..., (1, 1), ..., the derivatives of
/// column j by the component of column k. Its one export is for one lane: it takes one pointer to all results, number
/// after number, and then eight to arguments, of which it reads those that the row has.
struct LibrarySecondDerivative {
  LibraryFunction function;
  const LibraryDerivative* first;

  unsigned columns() const { return first->function.result_count / first->row->result_count - 1u; }
  /// Which list has the derivative of column j by the component of column k, in any order.
  unsigned list(unsigned j, unsigned k) const {
    return j <= k ? 1 + columns() + j * columns() - j * (j + 1) / 2 + k : list(k, j);
  }
};

/// All that there are (second_derivatives.def).
std::span<const LibrarySecondDerivative> library_second_derivatives();

/// That of `first`; null where the library has none.
const LibrarySecondDerivative* library_second_derivative(const LibraryDerivative& first);

/// Functions of vectors and matrices that the compiler takes apart into arithmetic before it differentiates twice.
bool is_linear_algebra(const LibraryFunction& row);

/// Whether a row can be differentiated twice, by some of its parameters at least; so can one that is constant.
bool has_second_derivatives(const LibraryFunction& row);

/// The derivative whose function this is.
const LibraryDerivative& derivative_of(const LibraryFunction& function);

/// The bitcode of all exports for one domain, without and of the derivatives; second derivatives are for one lane.
/// Static storage.
std::span<const char> library_bitcode(Precision precision, unsigned width);
std::span<const char> derivative_bitcode(Precision precision, unsigned width);
std::span<const char> second_derivative_bitcode(Precision precision);

/// How often the row of this symbol or export is differentiated: ms_<symbol>__<suffix>_<f32|f64>_w<W>, with a 2 before
/// the suffix where it is to the second order.
constexpr unsigned export_order(std::string_view name) {
  const size_t at = name.find("__");
  return at == std::string_view::npos ? 0 : name.substr(at + 2).starts_with('2') ? 2 : 1;
}
constexpr bool is_derivative_export(std::string_view name) { return export_order(name) != 0; }

/// A C function that the bitcode calls by name (the C library's own sin, pow, ... under names of ours, so that no
/// optimiser takes them for the functions it knows and rounds them another way).
struct LibraryExternal {
  const char* name;
  void* address;
};
std::span<const LibraryExternal> library_externals();

} // namespace moonshade
