// Lua's operators that are more than one instruction, and its math library where integers are concerned.
// Under double numbers they give what lvm.c and lmathlib.c of Lua 5.4 give, bit for bit; where Lua raises an error the
// result is 0 and the compiler reports the fault.
#pragma once

#include "stdlib/numbers.h"

namespace moonshade::stdlib {

// Integers ------------------------------------------------------------------------------------------------------------

/// Wrapping arithmetic, as Lua's: through unsigned, where it is defined.
template <class I> using Unsigned = Wide<std::make_unsigned_t<Scalar<I>>, width_of<I>>;
template <class I> MS_INLINE I wrapping_add(I a, I b) {
  return bit_cast<I>(bit_cast<Unsigned<I>>(a) + bit_cast<Unsigned<I>>(b));
}
template <class I> MS_INLINE I wrapping_subtract(I a, I b) {
  return bit_cast<I>(bit_cast<Unsigned<I>>(a) - bit_cast<Unsigned<I>>(b));
}

/// f(m, n) a lane at a time: for what vectors have no instruction for. A loop, so that it stays short.
template <class L, class F> MS_INLINE Int<L> lane_by_lane(Int<L> m, Int<L> n, F f) {
  int64_t dividends[width_of<L>], divisors[width_of<L>];
  __builtin_memcpy(dividends, &m, sizeof m);
  __builtin_memcpy(divisors, &n, sizeof n);
#pragma clang loop unroll(disable)
  for (int i = 0; i < width_of<L>; ++i)
    dividends[i] = f(dividends[i], divisors[i]);
  __builtin_memcpy(&m, dividends, sizeof m);
  return m;
}

/// A divisor without the two that trap: 0, and -1 (mininteger / -1); both become 1.
inline int64_t safe_divisor(int64_t n) { return n == 0 || n == -1 ? 1 : n; }

inline int64_t divide_one(int64_t m, int64_t n) {
  if (n == 0) return 0;
  if (n == -1) return wrapping_subtract(int64_t(0), m);
  const int64_t quotient = m / n;
  return quotient * n != m && (m ^ n) < 0 ? quotient - 1 : quotient;
}
inline int64_t modulo_one(int64_t m, int64_t n) {
  const int64_t rest = m % safe_divisor(n);
  return rest != 0 && (rest ^ n) < 0 ? rest + n : rest;
}

// Many lanes divide as doubles. Of integers below 2^51 the quotient, rounded, lies on the same side of every integer as
// the exact one (they are apart by 1/n at least, and a quotient below 2^51/n is rounded by less), so its floor is
// Lua's. What is greater takes the way of one lane; it is rare, so the quotient is made in any case, and shared.

/// 1.5 * 2^52: added to an integer below 2^51 as doubles, it leaves the integer in the lower bits.
inline constexpr int64_t kShiftedBits = 0x4338000000000000;
inline constexpr double kShift = 0x1.8p52;
template <class I> using Double = Wide<double, width_of<I>>;
template <class I> MS_INLINE Double<I> small_to_double(I i) {
  return bit_cast<Double<I>>(wrapping_add(i, I(kShiftedBits))) - Double<I>(kShift);
}
template <class I> MS_INLINE I small_to_integer(Double<I> x) {
  return wrapping_subtract(bit_cast<I>(x + Double<I>(kShift)), I(kShiftedBits));
}
/// Whether some lane of either is not below 2^51.
template <class I> MS_INLINE bool any_great(I m, I n) {
  const auto high = [](I i) { return bit_cast<Unsigned<I>>(wrapping_add(i, I(int64_t(1) << 51))) >> uint64_t(52); };
  return any(to_mask<Double<I>>((high(m) | high(n)) != Unsigned<I>(uint64_t(0))));
}

template <class L> MS_INLINE Int<L> integer_idiv(Int<L> m, Int<L> n) {
  if constexpr (width_of<L> == 1) {
    return divide_one(m, n);
  } else {
    using I = Int<L>;
    auto zero = to_mask<Double<I>>(n == I(0));
    Double<I> quotient = floor(small_to_double(m) / small_to_double(select(zero, I(1), n)));
    if (any_great(m, n)) return lane_by_lane<L>(m, n, divide_one);
    return select(zero, I(0), small_to_integer<I>(quotient));
  }
}

/// What `round` of the quotient leaves of m, on many lanes; `one` gives it for a lane of great integers.
template <class L, class Round, class One> MS_INLINE Int<L> rest_of_lanes(Int<L> m, Int<L> n, Round round, One one) {
  using I = Int<L>;
  auto zero = to_mask<Double<I>>(n == I(0));
  Double<I> dividend = small_to_double(m), divisor = small_to_double(select(zero, I(1), n));
  Double<I> rest = dividend - round(dividend / divisor) * divisor; // exact
  if (any_great(m, n)) return lane_by_lane<L>(m, n, one);
  return small_to_integer<I>(rest);
}

template <class L> MS_INLINE Int<L> integer_mod(Int<L> m, Int<L> n) {
  if constexpr (width_of<L> == 1)
    return modulo_one(m, n);
  else
    return rest_of_lanes<L>(m, n, [](auto x) __attribute__((always_inline)) { return floor(x); }, modulo_one);
}

/// math.fmod: the rest has the sign of m.
template <class L> MS_INLINE Int<L> integer_fmod(Int<L> m, Int<L> n) {
  if constexpr (width_of<L> == 1)
    return m % safe_divisor(n);
  else
    return rest_of_lanes<L>(
        m, n, [](auto x) __attribute__((always_inline)) { return trunc(x); }, integer_fmod<Scalar<L>>);
}

template <class L> MS_INLINE Int<L> shift_left(Int<L> x, Int<L> y) {
  UInt<L> bits = bit_cast<UInt<L>>(x), mask = UInt<L>(uint64_t(63));
  UInt<L> left = bits << (bit_cast<UInt<L>>(y) & mask);
  UInt<L> right = bits >> (bit_cast<UInt<L>>(wrapping_subtract(Int<L>(0), y)) & mask);
  UInt<L> shifted = select(to_mask<L>(y < Int<L>(0)), right, left);
  auto in_range = to_mask<L>(y > Int<L>(-64)) & to_mask<L>(y < Int<L>(64));
  return bit_cast<Int<L>>(select(in_range, shifted, UInt<L>(uint64_t(0))));
}
template <class L> MS_INLINE Int<L> shift_right(Int<L> x, Int<L> y) {
  return shift_left<L>(x, wrapping_subtract(Int<L>(0), y));
}

template <class L> MS_INLINE Int<L> integer_abs(Int<L> x) {
  return select(to_mask<L>(x < Int<L>(0)), wrapping_subtract(Int<L>(0), x), x);
}
template <class L> MS_INLINE Int<L> integer_min(Int<L> a, Int<L> b) { return select(to_mask<L>(b < a), b, a); }
template <class L> MS_INLINE Int<L> integer_max(Int<L> a, Int<L> b) { return select(to_mask<L>(a < b), b, a); }
template <class L> MS_INLINE Mask<L> unsigned_less(Int<L> a, Int<L> b) {
  return to_mask<L>(bit_cast<UInt<L>>(a) < bit_cast<UInt<L>>(b));
}

// Numbers to integers -------------------------------------------------------------------------------------------------

template <class L> MS_INLINE Results<Int<L>, Mask<L>> floor_to_integer(L x) {
  L whole = floor(x);
  return {to_integer(whole), fits_integer(whole)};
}
template <class L> MS_INLINE Results<Int<L>, Mask<L>> ceil_to_integer(L x) {
  L whole = ceil(x);
  return {to_integer(whole), fits_integer(whole)};
}
/// The integer that equals x, where there is one.
template <class L> MS_INLINE Results<Int<L>, Mask<L>> exact_integer(L x) {
  auto exact = fits_integer(x) & equal(floor(x), x);
  return {select(exact, to_integer(x), Int<L>(0)), exact};
}

// Comparisons of an integer with a number, exact as lvm.c's: i < x means i < ceil(x), and so on
// -------------------------

template <class L> MS_INLINE Mask<L> integer_less_number(Int<L> i, L x) {
  L whole = ceil(x);
  auto fits = fits_integer(whole);
  return (fits & to_mask<L>(i < to_integer(whole))) | (!fits & less(constant<L>(0), x));
}
template <class L> MS_INLINE Mask<L> integer_less_equal_number(Int<L> i, L x) {
  L whole = floor(x);
  auto fits = fits_integer(whole);
  return (fits & to_mask<L>(i <= to_integer(whole))) | (!fits & less(constant<L>(0), x));
}
template <class L> MS_INLINE Mask<L> number_less_integer(L x, Int<L> i) {
  L whole = floor(x);
  auto fits = fits_integer(whole);
  return (fits & to_mask<L>(to_integer(whole) < i)) | (!fits & less(x, constant<L>(0)));
}
template <class L> MS_INLINE Mask<L> number_less_equal_integer(L x, Int<L> i) {
  L whole = ceil(x);
  auto fits = fits_integer(whole);
  return (fits & to_mask<L>(to_integer(whole) <= i)) | (!fits & less(x, constant<L>(0)));
}
template <class L> MS_INLINE Mask<L> integer_equals_number(Int<L> i, L x) {
  auto exact = exact_integer(x);
  return exact.second & to_mask<L>(exact.first == i);
}

} // namespace moonshade::stdlib
