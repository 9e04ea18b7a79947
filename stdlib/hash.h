// Hashes: of values to a number in [0, 1), and of points of the integer lattice to 32 bits, for noise.
//
// All arithmetic is modulo 2^32, so every input has a defined hash, the same in both precisions and at every width.
// The mixing steps are multiplications by odd constants and shifts to the right, exclusively or-ed; constants from
// "lowbias32" (Chris Wellons, hash-prospector, 2018, public domain) and, for coordinates, primes near 2^32 / golden
// ratio^k as used by xxHash (Yann Collet).
#pragma once

#include "stdlib/vec.h"

namespace moonshade::stdlib {

/// A bijection of 32 bits in which every bit of the input flips every bit of the result with chance near 1/2.
template <class U> MS_INLINE U mix_bits(U x) {
  x ^= x >> 16u;
  x *= 0x7feb352du;
  x ^= x >> 15u;
  x *= 0x846ca68bu;
  return x ^ (x >> 16u);
}

/// 32 bits as a number in [0, 1): the upper 24, so that it is exact in float.
template <class L> MS_INLINE L unit_number(UInt32<L> bits) {
  return convert<L>(convert<Int32<L>>(bits >> 8u)) * constant<L>(0x1p-24);
}

/// Whether a float is hashed by its bits: -0 and every NaN are as 0, by one comparison.
template <class F> MS_INLINE auto has_own_bits(F x) {
  F zero = F(0.0f);
  return less(x, zero) | less(zero, x);
}

/// The bits that a number is hashed by: those of its float.
template <class L> MS_INLINE UInt32<L> hash_bits(L x) {
  auto rounded = convert<Wide<float, width_of<L>>>(x);
  return select(has_own_bits(rounded), bit_cast<UInt32<L>>(rounded), UInt32<L>(0u));
}

/// The same, mixed: 0 stays 0, so that nothing waits for the comparison.
template <class L> MS_INLINE UInt32<L> mixed_bits(L x) {
  auto rounded = convert<Wide<float, width_of<L>>>(x);
  return select(has_own_bits(rounded), mix_bits(bit_cast<UInt32<L>>(rounded)), UInt32<L>(0u));
}

/// An integer that is a float is hashed as that number (1 and 1.0 are equal in Lua), any other by its 64 bits.
template <class L> MS_INLINE UInt32<L> hash_bits_of_integer(Int<L> k) {
  using F = Wide<float, width_of<L>>;
  F rounded = convert<F>(k);
  auto is_float = to_mask<L>(to_integer(rounded) == k);
  auto high = convert<UInt32<L>>(bit_cast<UInt<L>>(k) >> uint64_t(32)), low = convert<UInt32<L>>(k);
  return select(is_float, bit_cast<UInt32<L>>(rounded), mix_bits(high + 0x9e3779b9u) ^ low);
}

template <class L> MS_INLINE L hash(L x) { return unit_number<L>(mixed_bits(x)); }
template <class L> MS_INLINE L hash_of_integer(Int<L> k) {
  return unit_number<L>(mix_bits(hash_bits_of_integer<L>(k)));
}
template <class L, int N> MS_INLINE L hash(Vec<N, L> v) {
  UInt32<L> sum = mixed_bits(v[0]);
#pragma clang loop unroll(full)
  for (int i = 1; i < N; ++i)
    sum = mix_bits(sum * 0x9e3779b1u + hash_bits(v[i]));
  return unit_number<L>(sum);
}

// The lattice of noise ------------------------------------------------------------------------------------------------

/// The integral number i as u = i + 0x4b400000 modulo 2^32, which the addition of a great number leaves in the lower
/// bits: exact for |i| <= 2^22 in float (beyond, a nearby integer) and |i| < 2^50 in double, defined for every input.
template <class L> MS_INLINE UInt32<L> lattice(L i) {
  if constexpr (is_f32<L>)
    return bit_cast<UInt32<L>>(i + constant<L>(0x1.8p23));
  else
    return convert<UInt32<L>>(bit_cast<Bits<L>>(i + constant<L>(0x1.8p52 + 0x4b400000)));
}

inline constexpr uint32_t kLatticePrimes[4] = {0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du, 0x27d4eb2fu};

/// Whether a hash has any of these bits.
template <class L> MS_INLINE Mask<L> hash_is_set(UInt32<L> hash, uint32_t bits) {
  return to_mask<L>((hash & UInt32<L>(bits)) != UInt32<L>(0u));
}

/// The sign bit of a number, taken from bit 31 of the hash.
template <class L> MS_INLINE Bits<L> sign_from(UInt32<L> hash) {
  if constexpr (is_f32<L>)
    return hash & UInt32<L>(0x80000000u);
  else
    return convert<Bits<L>>(hash & UInt32<L>(0x80000000u)) << Bits<L>(uint64_t(32));
}

/// A bit of the hash as a mask. (Shifts of the hash to the left would be made multiplications by the optimiser.)
template <class L> MS_INLINE Mask<L> hash_bit(UInt32<L> hash, int bit) {
  return hash_is_set<L>(hash, uint32_t(1) << bit);
}

/// The same from another bit.
template <class L> MS_INLINE Bits<L> sign_from_bit(UInt32<L> hash, int bit) {
  return select(hash_bit<L>(hash, bit), sign_bit<L>(), Bits<L>(0));
}

/// The last step of a lattice point's hash, from the exclusive or of its coordinates u times their primes: the square,
/// of which the upper half is good. Nearer to independent than a product with a constant, which keeps the differences
/// along a row.
template <class U> MS_INLINE U lattice_hash(U combined) { return combined * combined; }

} // namespace moonshade::stdlib
