// The rows of table.def as C++ types.
//
// MS_ROW turns a row into a struct Row_<symbol>, whose template Of<L> holds the function's type over the lane L and a
// call of it; Signature takes such a type apart. Everything derived from the table is built on these two.
#pragma once

#include "stdlib/color.h"
#include "stdlib/curl.h"
#include "stdlib/fractal.h"
#include "stdlib/gabor.h"
#include "stdlib/geometry.h"
#include "stdlib/grain.h"
#include "stdlib/matrix.h"
#include "stdlib/noise.h"
#include "stdlib/numbers.h"
#include "stdlib/operators.h"
#include "stdlib/pattern.h"
#include "stdlib/periodic_noise.h"
#include "stdlib/perlin.h"
#include "stdlib/sdf.h"
#include "stdlib/spline.h"
#include "stdlib/value_noise.h"
#include "stdlib/value_type.h"
#include "stdlib/worley.h"

#include <array>

namespace moonshade::stdlib {

/// Takes a function type apart.
template <class F> struct Signature;
template <class R, class... A> struct Signature<R(A...)> {
  static constexpr unsigned parameter_count = sizeof...(A);
  using Result = R;
  template <template <class...> class To> using Parameters = To<A...>;
};

/// The names that table.def uses for types, over the lane L. (export.cpp has a line for each, too.)
#define MS_TYPES(L)                                                                                                    \
  using Number = L;                                                                                                    \
  using Integer = ::moonshade::stdlib::Int<L>;                                                                         \
  using Boolean = ::moonshade::stdlib::Mask<L>;                                                                        \
  using Vec2 = ::moonshade::stdlib::Vec<2, L>;                                                                         \
  using Vec3 = ::moonshade::stdlib::Vec<3, L>;                                                                         \
  using Vec4 = ::moonshade::stdlib::Vec<4, L>;                                                                         \
  using Mat3 = ::moonshade::stdlib::Mat<3, L>;                                                                         \
  using Mat4 = ::moonshade::stdlib::Mat<4, L>;                                                                         \
  using IntegerIfAny = ::moonshade::stdlib::Results<::moonshade::stdlib::Int<L>, ::moonshade::stdlib::Mask<L>>;        \
  using NumberNumberNumber = ::moonshade::stdlib::Results<L, L, L>;

#define MS_ROW(symbol_, function_, type_)                                                                              \
  struct Row_##symbol_ {                                                                                               \
    template <class L> struct Of {                                                                                     \
      MS_TYPES(L)                                                                                                      \
      using Type = type_;                                                                                              \
      template <class... A> MS_INLINE static typename Signature<Type>::Result call(const A&... arguments) {            \
        using Given = decltype(::moonshade::stdlib::function_<L>(arguments...));                                       \
        static_assert(std::is_same_v<Given, typename Signature<Type>::Result>, "table.def: " #symbol_ "'s result");    \
        return ::moonshade::stdlib::function_<L>(arguments...);                                                        \
      }                                                                                                                \
      template <class... A>                                                                                            \
      MS_INLINE static typename Signature<Type>::Result call_for(Wanted wanted, const A&... arguments) {               \
        if constexpr (requires { ::moonshade::stdlib::function_<L>(wanted, arguments...); })                           \
          return ::moonshade::stdlib::function_<L>(wanted, arguments...);                                              \
        else                                                                                                           \
          return call(arguments...);                                                                                   \
      }                                                                                                                \
    };                                                                                                                 \
  };

/// The value types of C++ types over one double.
template <class T> inline constexpr ValueType value_type_of = ValueType::Number;
template <> inline constexpr ValueType value_type_of<Mask<double>> = ValueType::Boolean;
template <> inline constexpr ValueType value_type_of<int64_t> = ValueType::Integer;
template <int N> inline constexpr ValueType value_type_of<Vec<N, double>> = vector_type(N);
template <int N> inline constexpr ValueType value_type_of<Mat<N, double>> = matrix_type(N);

/// The result types of a function that gives T.
template <class T> struct ResultTypes {
  static constexpr std::array<ValueType, 1> value = {value_type_of<T>};
};
template <class... T> struct ResultTypes<Results<T...>> {
  static constexpr std::array<ValueType, sizeof...(T)> value = {value_type_of<T>...};
};
template <class... A> struct ParameterTypes {
  static constexpr std::array<ValueType, sizeof...(A)> value = {value_type_of<A>...};
};

} // namespace moonshade::stdlib
