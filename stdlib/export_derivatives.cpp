// The exports of the library's derivatives for one domain, made like export.cpp's and linked only where a shader's
// derivative is asked for:
//
//     void ms_<symbol>__<suffix>_<f32|f64>_w<W>(void* result..., void* column..., const void* argument...)
//
// where a column is one pointer for each result.
#include "stdlib/derivative.h"
#include "stdlib/export_memory.h"

namespace moonshade::stdlib {

/// Each result to its pointer.
template <class T> MS_INLINE void store_results(const T& results, void* const* to) {
  for_each_result(results, [&](const auto& result) __attribute__((always_inline)) {
    Memory<std::remove_cvref_t<decltype(result)>>::store(*to++, result);
  });
}

/// A row's parameters as pointers: stores result and columns, which come first among the pointers.
template <class Row, unsigned Active, class Type = typename Row::template Of<Lane>::Type> struct DerivativeCaller;
template <class Row, unsigned Active, class R, class... A> struct DerivativeCaller<Row, Active, R(A...)> {
  using Of = Derivative<Row, Active, Lane>;

  template <size_t Count> MS_INLINE static void call(void* const (&pointers)[Count]) {
    static_assert(Count == Of::pointers, "derivatives.def: the number of pointers");
    [&]<size_t... I, size_t... K>(std::index_sequence<I...>, std::index_sequence<K...>) __attribute__((always_inline)) {
      constexpr size_t first_argument = Of::results * (1 + Of::columns);
      const auto result = Of::of(Memory<A>::load(pointers[first_argument + I])...);
      store_results(Of::value(result), pointers);
      (store_results(Of::column(result, K), pointers + Of::results * (1 + K)), ...);
    }(std::index_sequence_for<A...>(), std::make_index_sequence<Of::columns>());
  }
};

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) MS_ROW(symbol, function, type)
#define DEFAULTS(...)
#include "stdlib/table.def"

} // namespace moonshade::stdlib

using namespace moonshade::stdlib;

#define POINTERS_3(P) P p0, P p1, P p2
#define POINTERS_4(P) POINTERS_3(P), P p3
#define POINTERS_5(P) POINTERS_4(P), P p4
#define POINTERS_6(P) POINTERS_5(P), P p5
#define POINTERS_7(P) POINTERS_6(P), P p6
#define POINTERS_8(P) POINTERS_7(P), P p7
#define POINTERS_9(P) POINTERS_8(P), P p8
#define POINTERS_10(P) POINTERS_9(P), P p9
#define POINTERS_11(P) POINTERS_10(P), P p10
#define POINTERS_12(P) POINTERS_11(P), P p11
#define POINTERS_13(P) POINTERS_12(P), P p12
#define POINTERS_14(P) POINTERS_13(P), P p13
#define POINTERS_15(P) POINTERS_14(P), P p14
#define POINTERS_16(P) POINTERS_15(P), P p15
#define POINTERS_17(P) POINTERS_16(P), P p16
#define POINTERS_18(P) POINTERS_17(P), P p17
#define POINTERS_19(P) POINTERS_18(P), P p18
#define POINTERS_20(P) POINTERS_19(P), P p19
#define POINTERS_21(P) POINTERS_20(P), P p20
#define POINTERS_22(P) POINTERS_21(P), P p21
#define POINTERS_23(P) POINTERS_22(P), P p22
#define POINTERS_24(P) POINTERS_23(P), P p23
#define POINTERS_25(P) POINTERS_24(P), P p24
#define POINTERS_26(P) POINTERS_25(P), P p25
#define POINTERS_27(P) POINTERS_26(P), P p26
#define POINTERS_28(P) POINTERS_27(P), P p27
#define POINTERS_29(P) POINTERS_28(P), P p28
#define POINTERS_30(P) POINTERS_29(P), P p29
#define POINTERS_31(P) POINTERS_30(P), P p30
#define POINTERS_32(P) POINTERS_31(P), P p31
#define POINTERS_33(P) POINTERS_32(P), P p32
#define POINTERS_34(P) POINTERS_33(P), P p33
#define POINTERS_35(P) POINTERS_34(P), P p34
#define POINTERS_36(P) POINTERS_35(P), P p35
#define NOTHING

#define DERIVATIVE(symbol, suffix, parameters, pointers)                                                               \
  extern "C" [[gnu::always_inline]] void EXPORT_NAME(symbol##__##suffix)(POINTERS_##pointers(void*)) {                 \
    DerivativeCaller<Row_##symbol, parameters>::call({POINTERS_##pointers(NOTHING)});                                  \
  }
#include "stdlib/derivatives.def"
