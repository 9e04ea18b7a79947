// The exports of the library's second derivatives for one domain, linked only where a shader differentiates twice:
//
//     void ms_<symbol>__2<suffix>_<f32|f64>_w<W>(void* results, const void* argument 0..7)
//
// All results lie behind one pointer, number after number (derivative.h states their order); arguments that the row
// does not have are ignored.
#include "stdlib/derivative.h"
#include "stdlib/export_memory.h"

namespace moonshade::stdlib {

template <class Row, unsigned Active, class Type = typename Row::template Of<Lane>::Type> struct SecondCaller;
template <class Row, unsigned Active, class R, class... A> struct SecondCaller<Row, Active, R(A...)> {
  using Of = SecondDerivative<Row, Active, Lane>;

  MS_INLINE static void call(void* results, void* const (&pointers)[8]) {
    static_assert(sizeof...(A) <= 8);
    [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      Of::store(static_cast<Lane*>(results), Memory<A>::load(pointers[I])...);
    }(std::index_sequence_for<A...>());
  }
};

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) MS_ROW(symbol, function, type)
#define DEFAULTS(...)
#include "stdlib/table.def"

} // namespace moonshade::stdlib

using namespace moonshade::stdlib;

#define SECOND_DERIVATIVE(symbol, suffix, parameters)                                                                  \
  extern "C" [[gnu::always_inline]] void EXPORT_NAME(symbol##__2##suffix)(                                             \
      void* results, void* p0, void* p1, void* p2, void* p3, void* p4, void* p5, void* p6, void* p7) {                 \
    SecondCaller<Row_##symbol, parameters>::call(results, {p0, p1, p2, p3, p4, p5, p6, p7});                           \
  }
#include "stdlib/second_derivatives.def"
