// The exports of the library's derivatives for one domain, made like export.cpp's and linked only where a shader's
// derivative is asked for:
//
//     void ms_<symbol>__<suffix>_<f32|f64>_w<W>(void* result, void* column..., const void* argument...)
#include "stdlib/derivative.h"
#include "stdlib/export_memory.h"

namespace moonshade::stdlib {

/// A row's parameters as pointers: stores result and columns, which come first among the pointers.
template <class Row, unsigned Active, class Type = typename Row::template Of<Lane>::Type> struct DerivativeCaller;
template <class Row, unsigned Active, class R, class... A> struct DerivativeCaller<Row, Active, R(A...)> {
  using Of = Derivative<Row, Active, Lane>;

  template <size_t Count> MS_INLINE static void call(void* const (&pointers)[Count]) {
    static_assert(Count == Of::pointers, "derivatives.def: the number of pointers");
    [&]<size_t... I, size_t... K>(std::index_sequence<I...>, std::index_sequence<K...>) __attribute__((always_inline)) {
      const auto result = Of::of(Memory<A>::load(pointers[1 + Of::columns + I])...);
      Memory<R>::store(pointers[0], Of::value(result));
      (Memory<R>::store(pointers[1 + K], Of::column(result, K)), ...);
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
#define NOTHING

#define DERIVATIVE(symbol, suffix, parameters, pointers)                                                               \
  extern "C" [[gnu::always_inline]] void EXPORT_NAME(symbol##__##suffix)(POINTERS_##pointers(void*)) {                 \
    DerivativeCaller<Row_##symbol, parameters>::call({POINTERS_##pointers(NOTHING)});                                  \
  }
#include "stdlib/derivatives.def"
