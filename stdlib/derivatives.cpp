// derivatives.def as data. Which entries of a derivative are zero for every argument is found by running its body once.
#include "stdlib/derivative.h"
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

const LibraryDerivative* library_derivative(const LibraryFunction& row, unsigned parameters) {
  const LibraryDerivative* best = nullptr;
  for (const LibraryDerivative& derivative : library_derivatives()) {
    if (derivative.row != &row) continue;
    best = &derivative;
    if ((parameters & ~derivative.parameters) == 0) break;
  }
  return best != nullptr && (best->parameters & parameters) != 0 ? best : nullptr;
}

} // namespace moonshade
