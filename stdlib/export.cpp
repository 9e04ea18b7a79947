// The exports of the library for one domain (library.h says what they look like): compiled to bitcode once for each
// lane type, with MS_SCALAR (float, double), MS_PRECISION (f32, f64) and MS_WIDTH given.
//
// Exports are always inlined into compiled shaders; what they call is inlined into them, but for internal functions
// that are rarely run.
#include "stdlib/export_memory.h"
#include "stdlib/signature.h"

namespace moonshade::stdlib {

/// Stores each result at its pointer; where there are several, the pointer may be null.
template <class T, size_t Count> MS_INLINE void store_results(const T& value, void* const (&pointers)[Count]) {
  int i = 0;
  for_each_result(value, [&](const auto& result) __attribute__((always_inline)) {
    void* pointer = pointers[i++];
    if (Count == 1 || pointer != nullptr) Memory<std::remove_cvref_t<decltype(result)>>::store(pointer, result);
  });
}
template <class... R> MS_INLINE Wanted wanted_of(R*... pointers) { return {{(pointers != nullptr)...}}; }

/// Loads a row's arguments, calls its function.
template <class Row, class... A> struct Caller {
  template <class... P> MS_INLINE static auto call(Wanted wanted, P... pointers) {
    return Row::call_for(wanted, Memory<A>::load(pointers)...);
  }
};
template <class Row> struct CallerOf {
  template <class... A> using With = Caller<Row, A...>;
  using Type = typename Signature<typename Row::Type>::template Parameters<With>;
};

} // namespace moonshade::stdlib

using namespace moonshade::stdlib;

// From a row's type, Result(Parameter...), the preprocessor takes the count of parameters and of results: the macro
// named after the result receives the parameters as its arguments.
#define COUNT(...) COUNT_(__VA_ARGS__ __VA_OPT__(, ) 8, 7, 6, 5, 4, 3, 2, 1, 0)
#define COUNT_(a, b, c, d, e, f, g, h, n, ...) n
#define PARAMETERS_Number(...) COUNT(__VA_ARGS__)
#define PARAMETERS_Integer(...) COUNT(__VA_ARGS__)
#define PARAMETERS_Boolean(...) COUNT(__VA_ARGS__)
#define PARAMETERS_Vec2(...) COUNT(__VA_ARGS__)
#define PARAMETERS_Vec3(...) COUNT(__VA_ARGS__)
#define PARAMETERS_Vec4(...) COUNT(__VA_ARGS__)
#define PARAMETERS_Mat3(...) COUNT(__VA_ARGS__)
#define PARAMETERS_Mat4(...) COUNT(__VA_ARGS__)
#define PARAMETERS_IntegerIfAny(...) COUNT(__VA_ARGS__)
#define PARAMETERS_NumberNumberNumber(...) COUNT(__VA_ARGS__)
#define RESULTS_Number(...) 1
#define RESULTS_Integer(...) 1
#define RESULTS_Boolean(...) 1
#define RESULTS_Vec2(...) 1
#define RESULTS_Vec3(...) 1
#define RESULTS_Vec4(...) 1
#define RESULTS_Mat3(...) 1
#define RESULTS_Mat4(...) 1
#define RESULTS_IntegerIfAny(...) 2
#define RESULTS_NumberNumberNumber(...) 3

#define JOIN(a, b) JOIN_(a, b)
#define JOIN_(a, b) a##b
#define DECLARE_RESULTS_1 void* r0
#define DECLARE_RESULTS_2 DECLARE_RESULTS_1, void* r1
#define DECLARE_RESULTS_3 DECLARE_RESULTS_2, void* r2
#define DECLARE_RESULTS_4 DECLARE_RESULTS_3, void* r3
#define DECLARE_PARAMETERS_1 const void* a0
#define DECLARE_PARAMETERS_2 DECLARE_PARAMETERS_1, const void* a1
#define DECLARE_PARAMETERS_3 DECLARE_PARAMETERS_2, const void* a2
#define DECLARE_PARAMETERS_4 DECLARE_PARAMETERS_3, const void* a3
#define DECLARE_PARAMETERS_5 DECLARE_PARAMETERS_4, const void* a4
#define DECLARE_PARAMETERS_6 DECLARE_PARAMETERS_5, const void* a5
#define DECLARE_PARAMETERS_7 DECLARE_PARAMETERS_6, const void* a6
#define DECLARE_PARAMETERS_8 DECLARE_PARAMETERS_7, const void* a7
#define PASS_RESULTS_1 r0
#define PASS_RESULTS_2 PASS_RESULTS_1, r1
#define PASS_RESULTS_3 PASS_RESULTS_2, r2
#define PASS_RESULTS_4 PASS_RESULTS_3, r3
#define PASS_PARAMETERS_1 a0
#define PASS_PARAMETERS_2 PASS_PARAMETERS_1, a1
#define PASS_PARAMETERS_3 PASS_PARAMETERS_2, a2
#define PASS_PARAMETERS_4 PASS_PARAMETERS_3, a3
#define PASS_PARAMETERS_5 PASS_PARAMETERS_4, a4
#define PASS_PARAMETERS_6 PASS_PARAMETERS_5, a5
#define PASS_PARAMETERS_7 PASS_PARAMETERS_6, a6
#define PASS_PARAMETERS_8 PASS_PARAMETERS_7, a7

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc)                                      \
  MS_ROW(symbol, function, type)                                                                                       \
  extern "C" [[gnu::always_inline]] void EXPORT_NAME(symbol)(JOIN(DECLARE_RESULTS_, RESULTS_##type),                   \
                                                             JOIN(DECLARE_PARAMETERS_, PARAMETERS_##type)) {           \
    store_results(CallerOf<Row_##symbol::Of<Lane>>::Type::call(wanted_of(JOIN(PASS_RESULTS_, RESULTS_##type)),         \
                                                               JOIN(PASS_PARAMETERS_, PARAMETERS_##type)),             \
                  {JOIN(PASS_RESULTS_, RESULTS_##type)});                                                              \
  }
#include "stdlib/table.def"
