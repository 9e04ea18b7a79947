// derivatives.def as data. Which entries of a derivative are zero for every argument is found by running its body once.
#include "stdlib/derivative.h"
#include "stdlib/images.h"
#include "stdlib/library.h"

#include <algorithm>
#include <vector>

namespace moonshade {
namespace {

using namespace stdlib;

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) MS_ROW(symbol, function, type)
#define DEFAULTS(...)
#include "stdlib/table.def"

/// A bit for each component of a result that depends on column k.
template <int N> uint16_t used(const Dual<double, N>& result, int k) { return result.on(k) ? 1 : 0; }
template <int M, int N> uint16_t used(const Vec<M, Dual<double, N>>& result, int k) {
  uint16_t bits = 0;
  for (int i = 0; i < M; ++i)
    bits |= uint16_t(result[i].on(k) ? 1u << i : 0u);
  return bits;
}
template <int M, int N> uint16_t used(const Mat<M, Dual<double, N>>& result, int k) {
  uint16_t bits = 0;
  for (int i = 0; i < M; ++i)
    bits |= uint16_t(used(result[i], k) << (M * i));
  return bits;
}
template <class T> uint16_t used(const T&, int) { return 0; } // an integer or boolean

template <class T> T some_argument() {
  if constexpr (std::is_same_v<T, double>)
    return 0.5;
  else
    return T{};
}

const LibraryFunction& row_of(std::string_view symbol) {
  return *std::ranges::find(library(), symbol, &LibraryFunction::symbol);
}

template <class Row, unsigned Active, class Type = typename Row::template Of<double>::Type> struct Description;
template <class Row, unsigned Active, class R, class... A> struct Description<Row, Active, R(A...)> {
  using Of = Derivative<Row, Active, double>;
  static LibraryDerivative of(std::string_view symbol, std::string_view name, std::string_view derivative_symbol) {
    static_assert(Of::results * (1 + Of::columns) <= LibraryFunction::kMaxResults);
    LibraryDerivative derivative = {};
    derivative.row = &row_of(symbol);
    derivative.parameters = Active;
    derivative.function = *derivative.row;
    derivative.function.name = name;
    derivative.function.symbol = derivative_symbol;
    derivative.function.componentwise = false;
    derivative.function.result_count = Of::results * (1 + Of::columns);
    const auto results = Of::of(some_argument<A>()...);
    for (int k = 0; k < Of::columns; ++k) {
      unsigned r = 0;
      for_each_result(results, [&](const auto& result) {
        const unsigned index = derivative.index(unsigned(k), r);
        derivative.function.results[Of::results + index] = derivative.row->results[r++];
        derivative.used[index] = used(result, k);
      });
    }
    return derivative;
  }
};

} // namespace

std::span<const LibraryDerivative> library_derivatives() {
#define DERIVATIVE(symbol, suffix, parameters, pointers)                                                               \
  Description<Row_##symbol, parameters>::of(#symbol, "derivative of " #symbol, #symbol "__" #suffix),
  static const std::vector<LibraryDerivative> derivatives = {
#include "stdlib/derivatives.def"
  };
  return derivatives;
}

namespace {

LibrarySecondDerivative second_of(const LibraryDerivative& first, std::string_view symbol) {
  LibrarySecondDerivative second{first.function, &first};
  const unsigned columns = second.columns(), lists = 1 + columns + columns * (columns + 1) / 2;
  LibraryFunction& function = second.function;
  function.symbol = symbol;
  function.result_count = 0;
  for (unsigned list = 0; list < lists; ++list)
    for (unsigned r = 0; r < first.row->result_count; ++r) {
      const ValueType type = first.row->results[r];
      const bool is_number = type != ValueType::Boolean && type != ValueType::Integer;
      function.results[function.result_count++] = is_number ? type : ValueType::Number;
    }
  return second;
}

const LibraryDerivative& derivative_named(std::string_view symbol) {
  return *std::ranges::find(library_derivatives(), symbol,
                            [](const LibraryDerivative& derivative) { return derivative.function.symbol; });
}

} // namespace

std::span<const LibrarySecondDerivative> library_second_derivatives() {
#define SECOND_DERIVATIVE(symbol, suffix, parameters)                                                                  \
  second_of(derivative_named(#symbol "__" #suffix), #symbol "__2" #suffix),
  static const std::vector<LibrarySecondDerivative> seconds = {
#include "stdlib/second_derivatives.def"
  };
  return seconds;
}

const LibrarySecondDerivative* library_second_derivative(const LibraryDerivative& first) {
  const auto found = std::ranges::find(library_second_derivatives(), &first, &LibrarySecondDerivative::first);
  return found == library_second_derivatives().end() ? nullptr : &*found;
}

bool has_second_derivatives(const LibraryFunction& row) {
  if (is_linear_algebra(row)) return true;
  if (is_texture(row)) return false;
  const auto is_of_row = [&row](const LibraryDerivative& derivative) { return derivative.row == &row; };
  if (std::ranges::none_of(library_derivatives(), is_of_row)) return true;
  return std::ranges::any_of(library_second_derivatives(),
                             [&](const LibrarySecondDerivative& second) { return is_of_row(*second.first); });
}

bool is_linear_algebra(const LibraryFunction& row) {
  static constexpr std::string_view kNames[] = {"dot",     "cross",   "length",      "distance",   "normalize",
                                                "reflect", "refract", "faceforward", "determinant"};
  return std::ranges::find(kNames, row.name) != std::end(kNames) || (row.name == "rotate" && row.parameter_count == 3);
}

const LibraryDerivative& derivative_of(const LibraryFunction& function) {
  return is_texture(function) ? texture_derivative() : derivative_named(function.symbol);
}

const LibraryDerivative* library_derivative(const LibraryFunction& row, unsigned parameters) {
  const LibraryDerivative* best = is_texture(row) ? &texture_derivative() : nullptr;
  for (const LibraryDerivative& derivative : library_derivatives()) {
    if (derivative.row != &row) continue;
    best = &derivative;
    if ((parameters & ~derivative.parameters) == 0) break;
  }
  return best != nullptr && (best->parameters & parameters) != 0 ? best : nullptr;
}

} // namespace moonshade
