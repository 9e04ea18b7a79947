// Improved Perlin noise by hand, with its published permutation: by look-ups of bytes in registers where the machine
// has them (AVX-512 VBMI), by gathers on other vectors, from memory on one lane.
#pragma once

#include "tests/bench/hand/lanes.h"

namespace hand {

inline constexpr uint8_t kPermutation[256] = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142,
    8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203,
    117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165,
    71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,
    55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,
    18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250,
    124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189,
    28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,
    129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,
    242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114,
    67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

template <class V> HAND V fade(V t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }
template <class V> HAND V lerp(V t, V a, V b) { return a + t * (b - a); }

/// The hashes of a cell's corners, as bytes: of z in `near`, of z + 1 in `far`; in each the corners (0, 0), (0, 1),
/// (1, 0), (1, 1) of x and y from the lowest byte on.
template <int N> struct CornerHashes {
  U<N> near, far;
};

/// An entry of the table and the one behind it, as the lower two bytes.
struct Doubled {
  uint8_t entry[260];
  constexpr Doubled() : entry() {
    for (int i = 0; i < 260; ++i)
      entry[i] = kPermutation[i & 255];
  }
};
inline constexpr Doubled kDoubled;
template <int N> HAND U<N> pair(U<N> i) {
  i &= 255u;
#ifdef __AVX2__
  if constexpr (N == 8)
    return bits<U<8>>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(kDoubled.entry), bits<__m256i>(i), 1));
#endif
  U<N> result;
  if constexpr (N > 8) {
    result.lo = pair<N / 2>(i.lo), result.hi = pair<N / 2>(i.hi);
  } else {
    for (int lane = 0; lane < N; ++lane)
      result[lane] = kDoubled.entry[i[lane]] | uint32_t(kDoubled.entry[i[lane] + 1]) << 8;
  }
  return result;
}
template <int N> HAND CornerHashes<N> corner_hashes(U<N> x, U<N> y, U<N> z) {
  const U<N> a = pair<N>(x), a0 = pair<N>(a + y), a1 = pair<N>((a >> 8) + y);
  const U<N> b00 = pair<N>(a0 + z), b01 = pair<N>((a0 >> 8) + z);
  const U<N> b10 = pair<N>(a1 + z), b11 = pair<N>((a1 >> 8) + z);
  const auto gathered = [&](uint32_t shift) __attribute__((always_inline)) {
    return (b00 >> shift & 255u) | (b01 >> shift & 255u) << 8 | (b10 >> shift & 255u) << 16 |
           (b11 >> shift & 255u) << 24;
  };
  return {gathered(0), gathered(8)};
}

#ifdef __AVX512VBMI__
/// The permutation at each byte, from four registers.
HAND __m512i permuted(__m512i index) {
  const __m512i low =
      _mm512_permutex2var_epi8(_mm512_loadu_si512(kPermutation), index, _mm512_loadu_si512(kPermutation + 64));
  const __m512i high =
      _mm512_permutex2var_epi8(_mm512_loadu_si512(kPermutation + 128), index, _mm512_loadu_si512(kPermutation + 192));
  return _mm512_mask_blend_epi8(_mm512_movepi8_mask(index), low, high);
}
/// Copies of the lowest byte.
HAND __m512i fourfold(U<16> x) {
  const __m512i spread = _mm512_set4_epi32(0x0c0c0c0c, 0x08080808, 0x04040404, 0x00000000);
  return _mm512_shuffle_epi8(bits<__m512i>(x), spread);
}
template <> HAND CornerHashes<16> corner_hashes<16>(U<16> x, U<16> y, U<16> z) {
  const __m512i xs = _mm512_add_epi8(fourfold(x), _mm512_set1_epi32(0x01010000));
  const __m512i ys = _mm512_add_epi8(fourfold(y), _mm512_set1_epi32(0x01000100));
  const __m512i at = _mm512_add_epi8(permuted(_mm512_add_epi8(permuted(xs), ys)), fourfold(z));
  return {bits<U<16>>(permuted(at)), bits<U<16>>(permuted(_mm512_add_epi8(at, _mm512_set1_epi8(1))))};
}
template <> HAND CornerHashes<32> corner_hashes<32>(U<32> x, U<32> y, U<32> z) {
  const CornerHashes<16> low = corner_hashes<16>(x.lo, y.lo, z.lo), high = corner_hashes<16>(x.hi, y.hi, z.hi);
  CornerHashes<32> both;
  both.near.lo = low.near, both.near.hi = high.near, both.far.lo = low.far, both.far.hi = high.far;
  return both;
}
#endif

/// The gradient at a corner along the way to it: one of twelve edges by the lower four bits of `hash`.
template <int N> HAND F<N> edge(U<N> hash, F<N> x, F<N> y, F<N> z) {
  const U<N> h = hash & 15u;
  const F<N> u = choose(h < 8u, x, y);
  const F<N> v = choose(h < 4u, y, choose((h & 13u) == 12u, x, z));
  return flip<N>(u, h << 31) + flip<N>(v, h << 30 & 0x80000000u);
}
#ifdef __AVX512F__
// The same from registers of sixteen coefficients.
alignas(64) inline constexpr float kEdgeX[16] = {1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0, 1, 0, -1, 0};
alignas(64) inline constexpr float kEdgeY[16] = {1, 1, -1, -1, 0, 0, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1};
alignas(64) inline constexpr float kEdgeZ[16] = {0, 0, 0, 0, 1, 1, -1, -1, 1, 1, -1, -1, 0, 1, 0, -1};
HAND F<16> coefficient(const float* table, U<16> hash) {
  return bits<F<16>>(_mm512_permutexvar_ps(bits<__m512i>(hash), _mm512_load_ps(table)));
}
HAND F<32> coefficient(const float* table, U<32> hash) {
  F<32> both;
  both.lo = coefficient(table, hash.lo), both.hi = coefficient(table, hash.hi);
  return both;
}
template <> HAND F<16> edge<16>(U<16> hash, F<16> x, F<16> y, F<16> z) {
  return coefficient(kEdgeX, hash) * x + coefficient(kEdgeY, hash) * y + coefficient(kEdgeZ, hash) * z;
}
template <> HAND F<32> edge<32>(U<32> hash, F<32> x, F<32> y, F<32> z) {
  return coefficient(kEdgeX, hash) * x + coefficient(kEdgeY, hash) * y + coefficient(kEdgeZ, hash) * z;
}
#endif

template <int N> HAND F<N> perlin(Vec3<N> p) {
  const F<N> i = floor(p.x), j = floor(p.y), k = floor(p.z);
  const F<N> x = p.x - i, y = p.y - j, z = p.z - k, x1 = x - 1.0f, y1 = y - 1.0f, z1 = z - 1.0f;
  const F<N> u = fade(x), v = fade(y), w = fade(z);
  const auto [near, far] =
      corner_hashes<N>(bits<U<N>>(to_int<N>(i)), bits<U<N>>(to_int<N>(j)), bits<U<N>>(to_int<N>(k)));
  const auto side = [&](U<N> h, F<N> z) __attribute__((always_inline)) {
    return lerp(v, lerp(u, edge<N>(h, x, y, z), edge<N>(h >> 16, x1, y, z)),
                lerp(u, edge<N>(h >> 8, x, y1, z), edge<N>(h >> 24, x1, y1, z)));
  };
  return lerp(w, side(near, z), side(far, z1));
}

/// The reference's way, for one lane.
template <> HAND float perlin<1>(Vec3<1> p) {
  const float i = __builtin_floorf(p.x), j = __builtin_floorf(p.y), k = __builtin_floorf(p.z);
  const float x = p.x - i, y = p.y - j, z = p.z - k, u = fade(x), v = fade(y), w = fade(z);
  const int X = int(i) & 255, Y = int(j) & 255, Z = int(k) & 255;
  const auto P = [](int at) { return int(kPermutation[at & 255]); };
  const auto grad = [](int hash, float x, float y, float z) {
    const int h = hash & 15;
    const float u = h < 8 ? x : y, v = h < 4 ? y : h == 12 || h == 14 ? x : z;
    return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
  };
  const int A = P(X) + Y, AA = P(A) + Z, AB = P(A + 1) + Z, B = P(X + 1) + Y, BA = P(B) + Z, BB = P(B + 1) + Z;
  return lerp(w,
              lerp(v, lerp(u, grad(P(AA), x, y, z), grad(P(BA), x - 1, y, z)),
                   lerp(u, grad(P(AB), x, y - 1, z), grad(P(BB), x - 1, y - 1, z))),
              lerp(v, lerp(u, grad(P(AA + 1), x, y, z - 1), grad(P(BA + 1), x - 1, y, z - 1)),
                   lerp(u, grad(P(AB + 1), x, y - 1, z - 1), grad(P(BB + 1), x - 1, y - 1, z - 1))));
}

} // namespace hand
