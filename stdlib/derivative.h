// A row of the table over dual numbers: its result and the derivatives by the components of some of its parameters.
#pragma once

#include "stdlib/dual.h"
#include "stdlib/signature.h"

#include <tuple>

namespace moonshade::stdlib {

/// Components of a parameter's or result's C++ type; 0 for integers and booleans, which have no derivative.
template <class L, class T> inline constexpr int components_of = std::is_same_v<T, L> ? 1 : 0;
template <class L, int N> inline constexpr int components_of<L, Vec<N, L>> = N;
template <class L, int N> inline constexpr int components_of<L, Mat<N, L>> = N * N;

/// Row (of MS_ROW) over the plain lane L, by the parameters whose bits are set in Active.
template <class Row, unsigned Active, class L, class Type = typename Row::template Of<L>::Type> class Derivative;

template <class Row, unsigned Active, class L, class R, class... A> class Derivative<Row, Active, L, R(A...)> {
public:
  static constexpr int first_column(size_t parameter) {
    constexpr int sizes[sizeof...(A)] = {components_of<L, A>...};
    int sum = 0;
    for (size_t i = 0; i < parameter; ++i)
      sum += (Active >> i & 1) != 0 ? sizes[i] : 0;
    return sum;
  }

  static constexpr unsigned parameter_count = sizeof...(A);
  /// A column is the derivative of the result (or of all results) by one component of one parameter, in order.
  static constexpr int columns = first_column(sizeof...(A));
  static constexpr unsigned results = result_count<R>;
  static constexpr unsigned pointers = results * (1 + columns) + parameter_count;
  using Result = R;
  using D = Dual<L, columns>;
  static_assert(columns > 0 && (Active >> parameter_count) == 0, "derivatives.def: no such parameters");

  /// The result over dual numbers.
  MS_INLINE static auto of(const A&... arguments) {
    return [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      return Row::template Of<D>::call(seed<I>(arguments)...);
    }(std::index_sequence_for<A...>());
  }
  /// The column of the result, or of each of several.
  template <class T> MS_INLINE static R column(const T& result, int k) {
    return map_results(result, [k](const auto& x) __attribute__((always_inline)) { return slope_of(x, k); });
  }
  template <class T> MS_INLINE static R value(const T& result) {
    return map_results(result, [](const auto& x) __attribute__((always_inline)) { return value_of(x); });
  }

private:
  MS_INLINE static L slope_of(const D& x, int k) { return x.d[k]; }
  template <int N> MS_INLINE static Vec<N, L> slope_of(const Vec<N, D>& v, int k) {
    return map<N, L>([k](const D& x) __attribute__((always_inline)) { return x.d[k]; }, v);
  }
  template <int N> MS_INLINE static Mat<N, L> slope_of(const Mat<N, D>& m, int k) {
    return map_columns<L>([k](const Vec<N, D>& column) __attribute__((always_inline)) { return slope_of(column, k); },
                          m);
  }
  template <class T> MS_INLINE static T slope_of(const T&, int) { return T{}; } // of an integer or boolean
  MS_INLINE static L value_of(const D& x) { return x.v; }
  template <int N> MS_INLINE static Vec<N, L> value_of(const Vec<N, D>& v) {
    return map<N, L>([](const D& x) __attribute__((always_inline)) { return x.v; }, v);
  }
  template <int N> MS_INLINE static Mat<N, L> value_of(const Mat<N, D>& m) {
    return map_columns<L>([](const Vec<N, D>& column) __attribute__((always_inline)) { return value_of(column); }, m);
  }
  template <class T> MS_INLINE static T value_of(const T& x) { return x; }

  template <size_t I> MS_INLINE static D seed(const L& number, int component = 0) {
    D result = D::of(number);
    if constexpr ((Active >> I & 1) != 0) {
      result.active = 1u << (first_column(I) + component);
      result.d[first_column(I) + component] = constant<L>(1);
    }
    return result;
  }
  template <size_t I, int N> MS_INLINE static Vec<N, D> seed(const Vec<N, L>& v, int first = 0) {
    return [&]<size_t... C>(std::index_sequence<C...>) __attribute__((always_inline)) {
      return Vec<N, D>{{seed<I>(v[C], first + int(C))...}};
    }(std::make_index_sequence<N>());
  }
  template <size_t I, int N> MS_INLINE static Mat<N, D> seed(const Mat<N, L>& m) {
    return [&]<size_t... C>(std::index_sequence<C...>) __attribute__((always_inline)) {
      return Mat<N, D>{{seed<I>(m[C], N * int(C))...}};
    }(std::make_index_sequence<N>());
  }
};

/// Numbers that a result's C++ type takes; integers and booleans count as one, for they have the derivative 0.
template <class L, class T> inline constexpr int numbers_of = 1;
template <class L, int N> inline constexpr int numbers_of<L, Vec<N, L>> = N;
template <class L, int N> inline constexpr int numbers_of<L, Mat<N, L>> = N * N;
template <class L, class... T> inline constexpr int numbers_of<L, Results<T...>> = (numbers_of<L, T> + ...);

/// The same to the second order, over dual numbers of dual numbers. Its results are lists of what the row gives: the
/// values, the columns, and the derivative of column j by the component of column k for each pair j <= k, in the order
/// (0, 0), (0, 1), ..., (1, 1), ...
template <class Row, unsigned Active, class L, class Type = typename Row::template Of<L>::Type> class SecondDerivative;

template <class Row, unsigned Active, class L, class R, class... A> class SecondDerivative<Row, Active, L, R(A...)> {
  using First = Derivative<Row, Active, L>;

public:
  static constexpr int columns = First::columns;
  static constexpr int lists = 1 + columns + columns * (columns + 1) / 2;
  static constexpr int stride = numbers_of<L, R>;
  using Inner = Dual<L, columns>;
  using D = Dual<Inner, columns>;

  /// Number after number.
  MS_INLINE static void store(L* to, const A&... arguments) {
    const auto results = [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      return Row::template Of<D>::call(seed<I>(arguments)...);
    }(std::index_sequence_for<A...>());
    for_each_result(results, [&](const auto& result) __attribute__((always_inline)) { to = put(to, result); });
  }

private:
  MS_INLINE static L* put(L* to, const D& d) {
    to[0] = d.v.v;
    [&]<size_t... J>(std::index_sequence<J...>) __attribute__((always_inline)) {
      ((to[(1 + int(J)) * stride] = d.v.d[J]), ...);
      (put_row<int(J)>(to, d, std::make_index_sequence<size_t(columns) - J>()), ...);
    }(std::make_index_sequence<size_t(columns)>());
    return to + 1;
  }
  template <int J, size_t... K> MS_INLINE static void put_row(L* to, const D& d, std::index_sequence<K...>) {
    constexpr int first = 1 + columns + J * columns - J * (J - 1) / 2;
    ((to[(first + int(K)) * stride] = d.d[J].d[J + int(K)]), ...);
  }
  template <int N> MS_INLINE static L* put(L* to, const Vec<N, D>& v) {
    return [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      return (put(to + I, v.c[I]), ...);
    }(std::make_index_sequence<size_t(N)>());
  }
  template <int N> MS_INLINE static L* put(L* to, const Mat<N, D>& m) {
    return [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      return (put(to + N * I, m.c[I]), ...);
    }(std::make_index_sequence<size_t(N)>());
  }
  template <class T> MS_INLINE static L* put(L* to, const T&) { // an integer or boolean
    for (int i = 0; i < lists; ++i)
      to[i * stride] = constant<L>(0);
    return to + 1;
  }

  template <size_t I> MS_INLINE static D seed(const L& number, int component = 0) {
    D result = D::of(Inner::of(number));
    if constexpr ((Active >> I & 1) != 0) {
      const int column = First::first_column(I) + component;
      result.v.active = result.active = 1u << column;
      result.v.d[column] = constant<L>(1);
      result.d[column] = constant<Inner>(1);
    }
    return result;
  }
  template <size_t I, int N> MS_INLINE static Vec<N, D> seed(const Vec<N, L>& v) {
    return [&]<size_t... C>(std::index_sequence<C...>) __attribute__((always_inline)) {
      return Vec<N, D>{{seed<I>(v[C], int(C))...}};
    }(std::make_index_sequence<size_t(N)>());
  }
};

} // namespace moonshade::stdlib
