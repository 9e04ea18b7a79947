// For tests: the rows of the library's table, called natively over double.
#include "compiler/ir/test_interpreter.h"
#include "stdlib/derivative.h"
#include "stdlib/signature.h"

#include <cstdlib>
#include <unordered_map>

namespace moonshade::ir::test {
namespace {

using namespace stdlib;

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) MS_ROW(symbol, function, type)
#define DEFAULTS(...)
#include "stdlib/table.def"

template <class T> struct Passing;
template <> struct Passing<double> {
  static double get(const Value& value) { return value.numbers[0]; }
  static Value put(double x) { return Value::of(x); }
};
template <> struct Passing<int64_t> {
  static int64_t get(const Value& value) { return value.integer; }
  static Value put(int64_t x) { return Value::of(x); }
};
template <> struct Passing<Mask<double>> {
  static Mask<double> get(const Value& value) { return {value.boolean}; }
  static Value put(Mask<double> x) { return Value::of(x.bits); }
};
template <int N> struct Passing<Vec<N, double>> {
  static Vec<N, double> get(const Value& value) {
    Vec<N, double> v;
    for (int i = 0; i < N; ++i)
      v[i] = value.numbers[i];
    return v;
  }
  static Value put(const Vec<N, double>& v) {
    Value value = Value::of(0.0);
    value.type = vector_type(N);
    for (int i = 0; i < N; ++i)
      value.numbers[i] = v[i];
    return value;
  }
};

template <int N> struct Passing<Mat<N, double>> {
  static Mat<N, double> get(const Value& value) {
    Mat<N, double> m;
    for (int i = 0; i < N * N; ++i)
      m[i / N][i % N] = value.numbers[size_t(i)];
    return m;
  }
  static Value put(const Mat<N, double>& m) {
    Value value = Value::of(0.0);
    value.type = matrix_type(N);
    for (int i = 0; i < N * N; ++i)
      value.numbers[size_t(i)] = m[i / N][i % N];
    return value;
  }
};

template <class R> void put_results(const R& results, std::vector<Value>& out) {
  for_each_result(
      results, [&](const auto& result) { out.push_back(Passing<std::remove_cvref_t<decltype(result)>>::put(result)); });
}

template <class Row, class Type> struct Native;
template <class Row, class R, class... A> struct Native<Row, R(A...)> {
  static std::vector<Value> call(const std::vector<Value>& operands) {
    return [&]<size_t... I>(std::index_sequence<I...>) {
      std::vector<Value> out;
      put_results(Row::call(Passing<A>::get(operands[I])...), out);
      return out;
    }(std::index_sequence_for<A...>());
  }
};

/// The results of a derivative, and their columns.
template <class Row, unsigned Active, class Type> struct NativeDerivative;
template <class Row, unsigned Active, class R, class... A> struct NativeDerivative<Row, Active, R(A...)> {
  static std::vector<Value> call(const std::vector<Value>& operands) {
    using Of = Derivative<Row, Active, double>;
    return [&]<size_t... I>(std::index_sequence<I...>) {
      const auto result = Of::of(Passing<A>::get(operands[I])...);
      std::vector<Value> out;
      put_results(Of::value(result), out);
      for (int k = 0; k < Of::columns; ++k)
        put_results(Of::column(result, k), out);
      return out;
    }(std::index_sequence_for<A...>());
  }
};

using NativeFunction = std::vector<Value> (*)(const std::vector<Value>&);

const std::unordered_map<std::string_view, NativeFunction>& natives() {
  static const std::unordered_map<std::string_view, NativeFunction> kNatives = {
#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc)                                      \
  {#symbol, &Native<Row_##symbol::Of<double>, Row_##symbol::Of<double>::Type>::call},
#define DEFAULTS(...)
#include "stdlib/table.def"
#define DERIVATIVE(symbol, suffix, parameters, pointers)                                                               \
  {#symbol "__" #suffix, &NativeDerivative<Row_##symbol, parameters, Row_##symbol::Of<double>::Type>::call},
#include "stdlib/derivatives.def"
  };
  return kNatives;
}

} // namespace

std::vector<Value> call_native(const LibraryFunction& row, ValueType type, const std::vector<Value>& operands) {
  const NativeFunction function = natives().at(row.symbol);
  if (!row.componentwise || !is_vector(type)) return function(operands);
  Value result;
  result.type = type;
  for (unsigned i = 0; i < component_count(type); ++i) {
    std::vector<Value> parts;
    parts.reserve(operands.size());
    for (const Value& operand : operands)
      parts.push_back(Value::of(operand.numbers[is_vector(operand.type) ? i : 0]));
    result.numbers[i] = function(parts)[0].numbers[0];
  }
  return {result};
}

} // namespace moonshade::ir::test
