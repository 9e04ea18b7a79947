// Random numbers as a pure function of (seed, pixel, sample, dimension), so that no thread, order or batch can change
// them: Sobol's first two dimensions with hash-based Owen scrambling (Burley 2020, "Practical Hash-based Owen
// Scrambling"; hash by Vegdahl), padded: every pair of dimensions is an independently shuffled (0,2)-sequence.
#pragma once

#include "renderer/math.h"

#include <cstdint>

namespace moonshade::renderer {

/// A well-mixing permutation of 32-bit integers (constants by C. Wellons' hash prospector, "lowbias32").
inline uint32_t hash32(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}
inline uint32_t hash_combine(uint32_t a, uint32_t b) { return hash32(a ^ (b * 0x9e3779b9u + 0x7f4a7c15u)); }

inline uint32_t reverse_bits(uint32_t x) {
#if defined(__clang__)
  return __builtin_bitreverse32(x);
#else
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
#endif
}

/// Owen scrambling of a number whose bits are reversed: each bit is flipped by a hash of the bits below it.
inline uint32_t laine_karras(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

inline uint32_t owen_scramble(uint32_t x, uint32_t seed) { return reverse_bits(laine_karras(reverse_bits(x), seed)); }

/// Second dimension of Sobol's sequence for index `x`, bit-reversed: Pascal's matrix modulo 2, by its factors.
inline uint32_t sobol_second_reversed(uint32_t x) {
  x ^= (x & 0xaaaaaaaau) >> 1;
  x ^= (x & 0xccccccccu) >> 2;
  x ^= (x & 0xf0f0f0f0u) >> 4;
  x ^= (x & 0xff00ff00u) >> 8;
  x ^= (x & 0xffff0000u) >> 16;
  return x;
}

/// In [0, 1): the upper 24 bits.
inline float unit_float(uint32_t x) { return float(x >> 8) * 0x1p-24f; }

/// The numbers of one sample of one pixel.
class Sampler {
public:
  Sampler() = default;
  Sampler(uint32_t seed, uint32_t pixel, uint32_t sample) : key_(hash_combine(hash32(seed), pixel)), sample_(sample) {}

  /// Numbers of its own for a part of the sample that draws an unknown count of them.
  Sampler fork(uint32_t salt) const {
    Sampler other = *this;
    other.key_ = hash_combine(key_ ^ 0x5bd1e995u, salt);
    return other;
  }

  float one(uint32_t dimension) const {
    uint32_t key = hash_combine(key_, dimension);
    uint32_t index = owen_scramble(sample_, key);
    return unit_float(laine_karras_reversed(index, hash32(key ^ 0x68bc21ebu)));
  }
  Vec2 two(uint32_t dimension) const {
    uint32_t key = hash_combine(key_, dimension);
    uint32_t index = owen_scramble(sample_, key);
    uint32_t x = laine_karras_reversed(index, hash32(key ^ 0x68bc21ebu));
    uint32_t y = reverse_bits(laine_karras(sobol_second_reversed(index), hash32(key ^ 0x02e5be93u)));
    return {unit_float(x), unit_float(y)};
  }

private:
  /// Sobol's first dimension is the index with its bits reversed.
  static uint32_t laine_karras_reversed(uint32_t index, uint32_t seed) {
    return reverse_bits(laine_karras(index, seed));
  }

  uint32_t key_ = 0, sample_ = 0;
};

} // namespace moonshade::renderer
