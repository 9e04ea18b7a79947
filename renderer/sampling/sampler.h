// Random numbers as a pure function of (seed, pixel, sample, dimension), so that no thread, order or batch can change
// them: Sobol's first two dimensions with hash-based Owen scrambling (Burley 2020, "Practical Hash-based Owen
// Scrambling"; hash by Vegdahl), padded: every pair of dimensions is an independently shuffled (0,2)-sequence. Written
// over U, one 32-bit integer or a vector of them, and the lane L of floats beside it.
#pragma once

#include "renderer/math.h"
#include "stdlib/lane.h"

#include <cstdint>

namespace moonshade::renderer {

/// A well-mixing permutation of 32-bit integers (constants by C. Wellons' hash prospector, "lowbias32").
template <class U> MS_INLINE U hash32(U x) {
  x ^= x >> U(16u);
  x *= U(0x7feb352du);
  x ^= x >> U(15u);
  x *= U(0x846ca68bu);
  x ^= x >> U(16u);
  return x;
}
template <class U> MS_INLINE U hash_combine(U a, stdlib::NonDeduced<U> b) {
  return hash32(U(a ^ (b * U(0x9e3779b9u) + U(0x7f4a7c15u))));
}

template <class U> MS_INLINE U reverse_bits(U x) { return __builtin_elementwise_bitreverse(x); }

/// Owen scrambling of a number whose bits are reversed: each bit is flipped by a hash of the bits below it.
template <class U> MS_INLINE U laine_karras(U x, stdlib::NonDeduced<U> seed) {
  x ^= x * U(0x3d20adeau);
  x += seed;
  x *= (seed >> U(16u)) | U(1u);
  x ^= x * U(0x05526c56u);
  x ^= x * U(0x53a22864u);
  return x;
}

/// Second dimension of Sobol's sequence for index `x`, bit-reversed: Pascal's matrix modulo 2, by its factors.
template <class U> MS_INLINE U sobol_second_reversed(U x) {
  x ^= (x & U(0xaaaaaaaau)) >> U(1u);
  x ^= (x & U(0xccccccccu)) >> U(2u);
  x ^= (x & U(0xf0f0f0f0u)) >> U(4u);
  x ^= (x & U(0xff00ff00u)) >> U(8u);
  x ^= (x & U(0xffff0000u)) >> U(16u);
  return x;
}

/// In [0, 1): the upper 24 bits.
template <class U> MS_INLINE auto unit_float(U x) {
  using L = stdlib::Wide<float, stdlib::width_of<U>>;
  return stdlib::convert<L>(stdlib::bit_cast<stdlib::Int32<L>>(U(x >> U(8u)))) * L(0x1p-24f);
}

/// Numbers of one sample of one pixel, or of several side by side.
template <class U> struct Draws {
  using L = stdlib::Wide<float, stdlib::width_of<U>>;
  U key, sample;

  MS_INLINE L one(U dimension) const {
    U k = hash_combine(key, dimension);
    return unit_float(first(index(k), k));
  }
  MS_INLINE void two(U dimension, L& x, L& y) const {
    U k = hash_combine(key, dimension), i = index(k);
    x = unit_float(first(i, k));
    y = unit_float(reverse_bits(laine_karras(sobol_second_reversed(i), hash32(U(k ^ U(0x02e5be93u))))));
  }

private:
  /// The sample's place in the dimension's own order.
  MS_INLINE U index(U k) const { return reverse_bits(laine_karras(reverse_bits(sample), k)); }
  /// Sobol's first dimension is the index with its bits reversed.
  MS_INLINE static U first(U index, U k) { return reverse_bits(laine_karras(index, hash32(U(k ^ U(0x68bc21ebu))))); }
};

/// The numbers of one sample of one pixel.
class Sampler {
public:
  Sampler() = default;
  Sampler(uint32_t seed, uint32_t pixel, uint32_t sample) : draws_{hash_combine(hash32(seed), pixel), sample} {}

  /// Numbers of its own for a part of the sample that draws an unknown count of them.
  Sampler fork(uint32_t salt) const {
    Sampler other = *this;
    other.draws_.key = hash_combine(draws_.key ^ 0x5bd1e995u, salt);
    return other;
  }

  float one(uint32_t dimension) const { return draws_.one(dimension); }
  Vec2 two(uint32_t dimension) const {
    Vec2 u;
    draws_.two(dimension, u.x, u.y);
    return u;
  }
  const Draws<uint32_t>& draws() const { return draws_; }

private:
  Draws<uint32_t> draws_{};
};

} // namespace moonshade::renderer
