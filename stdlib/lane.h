// Lanes: what every function of the library is written over.
//
// A lane type L stands for one number at W points at once: float or double (W = 1), or a clang vector of W of them.
// Function bodies use the operators + - * / and unary -, and the named functions below; never a branch on a lane's
// value, but select. Comparisons give a Mask<L>. So one body serves every width, both precisions, and types to come
// that carry more than a value. The IR that results is plain LLVM vector code without target intrinsics.
//
// Rounding: a*b+c is never contracted by the compiler. madd is the one way to ask for it: a fused multiply-add where
// numbers are floats (the same bits on every machine), two roundings where they are doubles (what interpreters do).
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#ifndef MS_INLINE // the bitcode's build has its own (CMakeLists.txt)
#define MS_INLINE [[gnu::always_inline]] inline
#endif

namespace moonshade::stdlib {

template <class T, int W> struct WideType {
  using type = T __attribute__((ext_vector_type(W)));
};
template <class T> struct WideType<T, 1> {
  using type = T;
};
/// W values of T side by side; T itself for W = 1.
template <class T, int W> using Wide = typename WideType<T, W>::type;

template <class L> struct LaneTraits {
  using Scalar = L;
  static constexpr int width = 1;
};
template <class T, int W> struct LaneTraits<T __attribute__((ext_vector_type(W)))> {
  using Scalar = T;
  static constexpr int width = W;
};
template <class L> using Scalar = typename LaneTraits<L>::Scalar;
template <class L> inline constexpr int width_of = LaneTraits<L>::width;
template <class L> inline constexpr bool is_f32 = std::is_same_v<Scalar<L>, float>;

/// Integers beside L: Lua's own of 64 bits, and the narrow ones of hashes.
template <class L> using Int = Wide<int64_t, width_of<L>>;
template <class L> using UInt = Wide<uint64_t, width_of<L>>;
template <class L> using Int32 = Wide<int32_t, width_of<L>>;
template <class L> using UInt32 = Wide<uint32_t, width_of<L>>;
/// The unsigned integer with the bits of a number.
template <class L> using Bits = Wide<std::conditional_t<is_f32<L>, uint32_t, uint64_t>, width_of<L>>;

// Masks ---------------------------------------------------------------------------------------------------------------

/// A truth value a lane: an integer as wide as a number, true where it is not 0; one lane's is a bool. Combined as
/// vectors of bits, which is what LLVM wants of masks.
template <class I, int W> struct LaneMask {
  using Bits = std::conditional_t<W == 1, bool, Wide<I, W>>;
  Bits bits;
};
template <class L> using Mask = LaneMask<std::conditional_t<is_f32<L>, int32_t, int64_t>, width_of<L>>;

// Vectors of bits only within an expression: as arguments and results they would pass through memory as bytes.
template <class I, int W> MS_INLINE LaneMask<I, W> operator&(LaneMask<I, W> a, LaneMask<I, W> b) {
  using B = Wide<bool, W>;
  if constexpr (W == 1)
    return {a.bits && b.bits};
  else
    return {
        __builtin_convertvector(__builtin_convertvector(a.bits, B) & __builtin_convertvector(b.bits, B), Wide<I, W>)};
}
template <class I, int W> MS_INLINE LaneMask<I, W> operator|(LaneMask<I, W> a, LaneMask<I, W> b) {
  using B = Wide<bool, W>;
  if constexpr (W == 1)
    return {a.bits || b.bits};
  else
    return {
        __builtin_convertvector(__builtin_convertvector(a.bits, B) | __builtin_convertvector(b.bits, B), Wide<I, W>)};
}
template <class I, int W> MS_INLINE LaneMask<I, W> operator!(LaneMask<I, W> a) {
  if constexpr (W == 1)
    return {!a.bits};
  else
    return {__builtin_convertvector(~__builtin_convertvector(a.bits, Wide<bool, W>), Wide<I, W>)};
}

/// The result of comparing lanes of any element type, as a mask of L.
template <class L, class V> MS_INLINE Mask<L> to_mask(V comparison) {
  if constexpr (width_of<L> == 1)
    return {comparison};
  else
    return {__builtin_convertvector(comparison, typename Mask<L>::Bits)};
}

/// True where any lane is. The one thing that code may branch on, and only to leave out work without effect.
template <class I, int W> MS_INLINE bool any(LaneMask<I, W> mask) {
  if constexpr (W == 1)
    return mask.bits;
  else
    return __builtin_reduce_or(mask.bits) != 0;
}

/// mask ? a : b, a lane at a time, for numbers and integers of any size.
template <class I, int W, class V> MS_INLINE V select(LaneMask<I, W> mask, V a, V b) {
  if constexpr (W == 1) {
    return mask.bits ? a : b;
  } else {
    using Condition = Wide<std::conditional_t<sizeof(Scalar<V>) == 8, int64_t, int32_t>, W>;
    return __builtin_convertvector(mask.bits != Wide<I, W>(I(0)), Condition) ? a : b;
  }
}

template <class L> MS_INLINE Mask<L> less(L a, L b) { return to_mask<L>(a < b); }
template <class L> MS_INLINE Mask<L> less_equal(L a, L b) { return to_mask<L>(a <= b); }
template <class L> MS_INLINE Mask<L> equal(L a, L b) { return to_mask<L>(a == b); }
template <class L> MS_INLINE Mask<L> is_nan(L a) { return to_mask<L>(a != a); } // NOLINT(misc-redundant-expression)

// Numbers -------------------------------------------------------------------------------------------------------------

/// A constant of every lane.
template <class L> MS_INLINE constexpr L constant(double value) { return L(Scalar<L>(value)); }
template <class L> MS_INLINE constexpr L infinity() { return constant<L>(__builtin_huge_val()); }
template <class L> MS_INLINE constexpr L not_a_number() { return constant<L>(__builtin_nan("")); }

/// Converts lanes of numbers or integers to another element type; float to integer only where the value fits.
template <class To, class From> MS_INLINE To convert(From value) {
  if constexpr (width_of<From> == 1)
    return static_cast<To>(value);
  else
    return __builtin_convertvector(value, To);
}
template <class To, class From> MS_INLINE To bit_cast(From value) { return __builtin_bit_cast(To, value); }

/// An operand of L: a value of it, or a constant.
template <class L, class T> MS_INLINE L operand(T value) {
  if constexpr (std::is_same_v<T, L>)
    return value;
  else
    return constant<L>(value);
}

/// a*b + c: fused for floats, rounded twice for doubles.
template <class L, class B, class C> MS_INLINE L madd(L a, B b, C c) {
  if constexpr (is_f32<L>)
    return __builtin_elementwise_fma(a, operand<L>(b), operand<L>(c));
  else
    return a * operand<L>(b) + operand<L>(c);
}
/// c - a*b, rounded as madd is.
template <class L, class B, class C> MS_INLINE L nmadd(L a, B b, C c) { return madd(-a, b, c); }
/// a*b + c rounded once, whatever the type.
template <class L, class B, class C> MS_INLINE L fused(L a, B b, C c) {
  return __builtin_elementwise_fma(a, operand<L>(b), operand<L>(c));
}

/// A function of several parameters takes its lane type from the first.
template <class T> struct Identity {
  using type = T;
};
template <class T> using NonDeduced = typename Identity<T>::type;

// As Lua's math.min and math.max: the first unless the second is less (greater), so a NaN wins only as the first.
template <class L> MS_INLINE L min(L a, NonDeduced<L> b) { return select(less(b, a), b, a); }
template <class L> MS_INLINE L max(L a, NonDeduced<L> b) { return select(less(a, b), b, a); }

template <class L> MS_INLINE L floor(L x) { return __builtin_elementwise_floor(x); }
template <class L> MS_INLINE L ceil(L x) { return __builtin_elementwise_ceil(x); }
template <class L> MS_INLINE L trunc(L x) { return __builtin_elementwise_trunc(x); }
template <class L> MS_INLINE L sqrt(L x) { return __builtin_elementwise_sqrt(x); }

template <class L> MS_INLINE constexpr Bits<L> sign_bit() {
  return Bits<L>(Scalar<Bits<L>>(1) << (8 * sizeof(Scalar<L>) - 1));
}
template <class L> MS_INLINE L abs(L x) { return bit_cast<L>(bit_cast<Bits<L>>(x) & ~sign_bit<L>()); }
/// x with its sign flipped where `sign` has the sign bit.
template <class L> MS_INLINE L flip_sign(L x, Bits<L> sign) { return bit_cast<L>(bit_cast<Bits<L>>(x) ^ sign); }
template <class L> MS_INLINE L copy_sign(L magnitude, L sign) {
  return bit_cast<L>((bit_cast<Bits<L>>(magnitude) & ~sign_bit<L>()) | (bit_cast<Bits<L>>(sign) & sign_bit<L>()));
}
template <class L> MS_INLINE Mask<L> sign_is_set(L x) {
  return to_mask<L>((bit_cast<Bits<L>>(x) & sign_bit<L>()) != Bits<L>(0));
}

/// sum of coefficients[i] x^i by Horner's rule, each step rounded as madd is.
template <class L, size_t N> MS_INLINE L polynomial(L x, const Scalar<L> (&coefficients)[N]) {
  L sum = L(coefficients[N - 1]);
#pragma clang loop unroll(full)
  for (size_t i = N - 1; i-- > 0;)
    sum = madd(sum, x, L(coefficients[i]));
  return sum;
}
/// The same, each step fused also for doubles.
template <class L, size_t N> MS_INLINE L fused_polynomial(L x, const Scalar<L> (&coefficients)[N]) {
  L sum = L(coefficients[N - 1]);
#pragma clang loop unroll(full)
  for (size_t i = N - 1; i-- > 0;)
    sum = fused(sum, x, L(coefficients[i]));
  return sum;
}

// Conversion to integers, defined for every number --------------------------------------------------------------------

/// Where the integral number x is a 64-bit integer.
template <class L> MS_INLINE Mask<L> fits_integer(L x) {
  return less_equal(constant<L>(-0x1p63), x) & less(x, constant<L>(0x1p63));
}
/// The integral number x as an integer; 0 where it is none of 64 bits.
template <class L> MS_INLINE Int<L> to_integer(L x) {
  return convert<Int<L>>(select(fits_integer(x), x, constant<L>(0)));
}

/// Several results of one function.
template <class... T> struct Results;
template <class A, class B> struct Results<A, B> {
  A first;
  B second;
};
template <class A, class B, class C> struct Results<A, B, C> {
  A first;
  B second;
  C third;
};

/// Which of several results somebody uses. A function that can save work by it takes it as its first argument, too.
struct Wanted {
  bool result[3];
  MS_INLINE constexpr bool operator[](int i) const { return result[i]; }
  MS_INLINE static constexpr Wanted all() { return {{true, true, true}}; }
};

/// f of each result, in order; of the one value, where there are not several.
template <class T, class F> MS_INLINE void for_each_result(const T& value, F f) { f(value); }
template <class A, class B, class F> MS_INLINE void for_each_result(const Results<A, B>& results, F f) {
  f(results.first), f(results.second);
}
template <class A, class B, class C, class F> MS_INLINE void for_each_result(const Results<A, B, C>& results, F f) {
  f(results.first), f(results.second), f(results.third);
}
/// Results of f of each result; f of the one value.
template <class T, class F> MS_INLINE auto map_results(const T& value, F f) { return f(value); }
template <class A, class B, class F> MS_INLINE auto map_results(const Results<A, B>& results, F f) {
  return Results<decltype(f(results.first)), decltype(f(results.second))>{f(results.first), f(results.second)};
}
template <class A, class B, class C, class F> MS_INLINE auto map_results(const Results<A, B, C>& results, F f) {
  return Results<decltype(f(results.first)), decltype(f(results.second)), decltype(f(results.third))>{
      f(results.first), f(results.second), f(results.third)};
}
/// How many there are.
template <class T> inline constexpr int result_count = 1;
template <class... T> inline constexpr int result_count<Results<T...>> = int(sizeof...(T));

} // namespace moonshade::stdlib
