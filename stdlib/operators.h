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

/// A divisor without the two that trap: 0, and -1 (mininteger / -1); both become 1.
template <class L> MS_INLINE Int<L> safe_divisor(Int<L> n) {
  auto special = to_mask<L>(n == Int<L>(0)) | to_mask<L>(n == Int<L>(-1));
  return select(special, Int<L>(1), n);
}

template <class L> MS_INLINE Int<L> integer_idiv(Int<L> m, Int<L> n) {
  Int<L> divisor = safe_divisor<L>(n);
  Int<L> quotient = m / divisor;
  auto inexact = to_mask<L>(quotient * divisor != m), opposite = to_mask<L>((m ^ n) < Int<L>(0));
  quotient = select(inexact & opposite, wrapping_subtract(quotient, Int<L>(1)), quotient);
  quotient = select(to_mask<L>(n == Int<L>(-1)), wrapping_subtract(Int<L>(0), m), quotient);
  return select(to_mask<L>(n == Int<L>(0)), Int<L>(0), quotient);
}

template <class L> MS_INLINE Int<L> integer_mod(Int<L> m, Int<L> n) {
  Int<L> rest = m % safe_divisor<L>(n);
  auto inexact = to_mask<L>(rest != Int<L>(0)), opposite = to_mask<L>((rest ^ n) < Int<L>(0));
  return select(inexact & opposite, wrapping_add(rest, n), rest);
}

/// math.fmod: the rest has the sign of m.
template <class L> MS_INLINE Int<L> integer_fmod(Int<L> m, Int<L> n) { return m % safe_divisor<L>(n); }

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
