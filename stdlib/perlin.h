// Improved Perlin noise (Ken Perlin, "Improving Noise", SIGGRAPH 2002), after the reference implementation, with its
// published permutation: in double, the same bits. In four dimensions after Perlin's ImprovedNoise4D (the 32 edges of a
// tesseract); `pperlin` repeats after periods of one's own, `vperlin` is three noises.
//
// A lattice point's gradient is found by chained look-ups in the permutation; in fewer than three dimensions the
// coordinates left out are 0, as the reference is called. Defined everywhere: beyond 2^22 (float) or 2^50 (double) the
// cell is a nearby one. NaN and infinity give NaN. Period 256 in every direction; 0 at the integers; twice continuously
// differentiable; in 1 to 4 dimensions within 1, 1, 1.04 and 1.5.
#pragma once

#include "stdlib/hash.h"
#include "stdlib/numbers.h"
#include "stdlib/tables.h"
#include "stdlib/value_noise.h"

#include <initializer_list>

namespace moonshade::stdlib {

/// The permutation, and again its beginning, so that an entry and the one after it are read together.
struct PerlinTable {
  uint8_t entry[260];
};
inline constexpr uint8_t kPerlinPermutation[256] = {
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
static constexpr PerlinTable kPerlinTable = [] {
  PerlinTable table = {};
  for (int i = 0; i < 260; ++i)
    table.entry[i] = kPerlinPermutation[i & 255];
  return table;
}();

/// The reference's twelve edges, four of them twice: a corner's gradient by the lower four bits of its hash.
struct PerlinEdges {
  float x[16], y[16], z[16];
};
alignas(64) static constexpr PerlinEdges kPerlinEdges = {{1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0, 1, 0, -1, 0},
                                                         {1, 1, -1, -1, 0, 0, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1},
                                                         {0, 0, 0, 0, 1, 1, -1, -1, 1, 1, -1, -1, 0, 1, 0, -1}};

extern "C" {
// In the bitcode: 32 bits from the table at each of W byte offsets (gather.ll.in).
void moonshade_gather_w4(void* result, const void* table, const void* offsets);
void moonshade_gather_w8(void* result, const void* table, const void* offsets);
void moonshade_gather_w16(void* result, const void* table, const void* offsets);
void moonshade_gather_w32(void* result, const void* table, const void* offsets);
}

/// permutation[i mod 256] in the lowest byte, the following entry in the next; above, anything.
template <class U> MS_INLINE U permuted_pair(U i) {
  constexpr int width = width_of<U>;
  i &= U(255u);
  U result;
  if constexpr (width == 1) result = kPerlinTable.entry[i] | U(kPerlinTable.entry[i + 1]) << 8;
  if constexpr (width == 4) moonshade_gather_w4(&result, &kPerlinTable, &i);
  if constexpr (width == 8) moonshade_gather_w8(&result, &kPerlinTable, &i);
  if constexpr (width == 16) moonshade_gather_w16(&result, &kPerlinTable, &i);
  if constexpr (width == 32) moonshade_gather_w32(&result, &kPerlinTable, &i);
  return result;
}

/// For each hash below 16 in `set` its bit, counted from the uppermost down.
consteval uint32_t bits_of_hashes(std::initializer_list<int> set) {
  uint32_t bits = 0;
  for (const int hash : set)
    bits |= 0x80000000u >> hash;
  return bits;
}

/// What the reference's grad adds up: one of twelve edges (four of them twice) by the lower four bits of the hash. Here
/// the component of the earlier axis always is the first. A shift brings the hash's bit in a set to the sign's place.
template <class L> struct PerlinTerms {
  L first, second;
  MS_INLINE PerlinTerms(UInt32<L> hash, L x, L y, L z) {
    using U = UInt32<L>;
    const U h = hash & U(15u);
    const auto shifted = [&](uint32_t set) __attribute__((always_inline)) { return U(set) << h; };
    const auto holds = [&](uint32_t set) __attribute__((always_inline)) {
      return to_mask<L>(convert<Int32<L>>(shifted(set)) < Int32<L>(0));
    };
    constexpr uint32_t kFirstIsX = bits_of_hashes({0, 1, 2, 3, 4, 5, 6, 7, 12, 14});
    constexpr uint32_t kSecondIsY = bits_of_hashes({0, 1, 2, 3, 12, 14});
    constexpr uint32_t kFirstIsNegative = bits_of_hashes({1, 3, 5, 7, 9, 11, 13, 14, 15});
    constexpr uint32_t kSecondIsNegative = bits_of_hashes({2, 3, 6, 7, 10, 11, 15});
    first = flip_sign(select(holds(kFirstIsX), x, y), sign_from<L>(shifted(kFirstIsNegative)));
    second = flip_sign(select(holds(kSecondIsY), y, z), sign_from<L>(shifted(kSecondIsNegative)));
  }
};
template <class L> MS_INLINE L perlin_ramp(UInt32<L> hash, L x, L y, L z) {
  const PerlinTerms<L> terms(hash, x, y, z);
  return terms.first + terms.second;
}

template <class L> MS_INLINE L perlin_lerp(L t, L a, L b) { return madd(t, b - a, a); }

/// From `a` to the ramp. In float the difference is taken first from the component of the last axis, as
/// `perlin_product_less` does.
template <class L> MS_INLINE L perlin_lerp_to_ramp(L t, L a, UInt32<L> hash, L x, L y, L z) {
  const PerlinTerms<L> terms(hash, x, y, z);
  if constexpr (is_f32<L>)
    return madd(t, terms.first + (terms.second - a), a);
  else
    return perlin_lerp(t, a, terms.first + terms.second);
}

// Where a machine has tables in registers (tables.h) they give both: the permutation at the four bytes of a lane, and
// the three coefficients of a corner's gradient. All look-ups of a cell are then four.

/// The lowest byte, four times.
template <class U> MS_INLINE U fourfold(U x) {
  constexpr int bytes = 4 * width_of<U>;
  using Bytes = Wide<uint8_t, bytes>;
  return [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    const auto b = bit_cast<Bytes>(x);
    return bit_cast<U>(__builtin_shufflevector(b, b, int(I & ~size_t(3))...));
  }(std::make_index_sequence<size_t(bytes)>());
}
template <class U> MS_INLINE U add_bytes(U a, U b) {
  using Bytes = Wide<uint8_t, 4 * width_of<U>>;
  return bit_cast<U>(bit_cast<Bytes>(a) + bit_cast<Bytes>(b));
}

/// The ramp as a scalar product. What it adds to the sum of two components is zeros, so it has their bits but for the
/// sign of a zero.
template <class L> MS_INLINE L perlin_product(UInt32<L> hash, L x, L y, L z) {
  const L a = table_of_16<L>(kPerlinEdges.x, hash), b = table_of_16<L>(kPerlinEdges.y, hash);
  const L c = table_of_16<L>(kPerlinEdges.z, hash);
  return madd(a, x, madd(b, y, c * z));
}
/// The same less a number, by as many operations.
template <class L> MS_INLINE L perlin_product_less(L less, UInt32<L> hash, L x, L y, L z) {
  const L a = table_of_16<L>(kPerlinEdges.x, hash), b = table_of_16<L>(kPerlinEdges.y, hash);
  const L c = table_of_16<L>(kPerlinEdges.z, hash);
  return madd(a, x, madd(b, y, madd(c, z, -less)));
}

/// Everything is made where it is first needed: there are not registers enough for all of it.
template <class L> MS_INLINE L perlin_by_tables(UInt32<L> cx, UInt32<L> cy, UInt32<L> cz, L x, L y, L z) {
  using U = UInt32<L>;
  L one = constant<L>(1);
  // The bytes of a lane are the corners (0, 0), (0, 1), (1, 0), (1, 1) of x and y.
  U a = table_of_256(kPerlinTable.entry, add_bytes(fourfold(cx), U(0x01010000u)));
  U ab = table_of_256(kPerlinTable.entry, add_bytes(a, add_bytes(fourfold(cy), U(0x01000100u))));
  U at = add_bytes(ab, fourfold(cz));
  const auto side = [&](U hash, L z) __attribute__((always_inline)) {
    const auto row = [&](U left, U right, L y) __attribute__((always_inline)) {
      L a = perlin_product(left, x, y, z);
      return madd(fade(x), perlin_product_less(a, right, x - one, y, z), a);
    };
    L low = row(hash, hash >> U(16u), y), high = row(hash >> U(8u), hash >> U(24u), y - one);
    return perlin_lerp(fade(y), low, high);
  };
  L near = side(table_of_256(kPerlinTable.entry, at), z);
  L far = side(table_of_256(kPerlinTable.entry, add_bytes(at, U(0x01010101u))), z - one);
  return perlin_lerp(fade(z), near, far);
}

template <class L> MS_INLINE L perlin(Vec<3, L> p) {
  using U = UInt32<L>;
  L i = floor(p[0]), j = floor(p[1]), k = floor(p[2]);
  L x = p[0] - i, y = p[1] - j, z = p[2] - k, zero = constant<L>(0);
  U cx = lattice(i), cy = lattice(j), cz = lattice(k);
  if constexpr (has_tables<L>)
    if (moonshade_target_has_tables()) return perlin_by_tables<L>(cx, cy, cz, x, y, z) + zero;
  L one = constant<L>(1), u = fade(x), v = fade(y), w = fade(z), x1 = x - one, y1 = y - one, z1 = z - one;
  U byte = U(8u), low = U(255u);
  U ab = permuted_pair(cx);
  U aa_ab = permuted_pair((ab & low) + cy), ba_bb = permuted_pair((ab >> byte) + cy);
  U aa = permuted_pair((aa_ab & low) + cz), aab = permuted_pair((aa_ab >> byte) + cz);
  U ba = permuted_pair((ba_bb & low) + cz), bab = permuted_pair((ba_bb >> byte) + cz);
  const auto row = [&](U left, U right, L y, L z) __attribute__((always_inline)) {
    return perlin_lerp_to_ramp(u, perlin_ramp(left, x, y, z), right, x1, y, z);
  };
  L near = perlin_lerp(v, row(aa, ba, y, z), row(aab, bab, y1, z));
  L far = perlin_lerp(v, row(aa >> byte, ba >> byte, y, z1), row(aab >> byte, bab >> byte, y1, z1));
  return perlin_lerp(w, near, far) + zero; // a zero is +0, however it came about
}

template <class L> MS_INLINE L perlin(Vec<2, L> p) {
  using U = UInt32<L>;
  L i = floor(p[0]), j = floor(p[1]);
  L x = p[0] - i, y = p[1] - j, one = constant<L>(1), zero = constant<L>(0);
  L u = fade(x), v = fade(y), x1 = x - one, y1 = y - one;
  U cx = lattice(i), cy = lattice(j), byte = U(8u), low = U(255u);
  U ab = permuted_pair(cx);
  U aa_ab = permuted_pair((ab & low) + cy), ba_bb = permuted_pair((ab >> byte) + cy);
  U aa = permuted_pair(aa_ab & low), aab = permuted_pair(aa_ab >> byte);
  U ba = permuted_pair(ba_bb & low), bab = permuted_pair(ba_bb >> byte);
  return perlin_lerp(v, perlin_lerp(u, perlin_ramp(aa, x, y, zero), perlin_ramp(ba, x1, y, zero)),
                     perlin_lerp(u, perlin_ramp(aab, x, y1, zero), perlin_ramp(bab, x1, y1, zero)));
}

template <class L> MS_INLINE L perlin(L p) {
  using U = UInt32<L>;
  L i = floor(p), x = p - i, zero = constant<L>(0);
  U byte = U(8u), low = U(255u), ab = permuted_pair(lattice(i));
  U aa = permuted_pair(permuted_pair(ab & low) & low), ba = permuted_pair(permuted_pair(ab >> byte) & low);
  return perlin_lerp(fade(x), perlin_ramp(aa, x, zero, zero), perlin_ramp(ba, x - constant<L>(1), zero, zero));
}

// In four dimensions, with periods, and three at once: one body over the coordinates of the cell's corners -----------

/// One look-up.
template <class U> MS_INLINE U permuted(U i) { return permuted_pair(i) & U(255u); }

/// The ramp by the number of dimensions; those left out are 0.
template <class L, int N> MS_INLINE L perlin_ramp_of(UInt32<L> hash, const Vec<N, L>& d) {
  using U = UInt32<L>;
  L zero = constant<L>(0);
  if constexpr (N == 1) return perlin_ramp(hash, d[0], zero, zero);
  if constexpr (N == 2) return perlin_ramp(hash, d[0], d[1], zero);
  if constexpr (N == 3) return perlin_ramp(hash, d[0], d[1], d[2]);
  if constexpr (N == 4) {
    // Bits 3 and 4: x y z, w x y, z w x, y z w; bits 2, 1, 0: their signs.
    auto odd = hash_is_set<L>(hash, 8u), upper = hash_is_set<L>(hash, 16u);
    L a = select(upper, select(odd, d[1], d[2]), select(odd, d[3], d[0]));
    L b = select(upper, select(odd, d[2], d[3]), select(odd, d[0], d[1]));
    L c = select(upper, select(odd, d[3], d[0]), select(odd, d[1], d[2]));
    return flip_sign(a, sign_from<L>((hash & U(4u)) << U(29u))) + flip_sign(b, sign_from<L>((hash & U(2u)) << U(30u))) +
           flip_sign(c, sign_from<L>(hash << U(31u)));
  }
}

/// The ramp alone, or with its slopes, which are its values at 1 on each axis.
template <class T, class L, int N> MS_INLINE T perlin_corner(UInt32<L> hash, const Vec<N, L>& d) {
  T corner = {perlin_ramp_of<L>(hash, d)};
  if constexpr (!std::is_same_v<T, Flat<L>>) {
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i) {
      Vec<N, L> unit = {};
      unit[i] = constant<L>(1);
      corner.slope[i] = perlin_ramp_of<L>(hash, unit);
    }
  }
  return corner;
}

/// The corners of a cell and interpolation over them, from the axis `Axis` on, for K noises.
template <class L, int N, int K> struct PerlinCell {
  UInt32<L> corner[N][2];
  Vec<N, L> place, fades, slopes;

  /// `wrap(i, axis)` is an integral coordinate as it is, or modulo a period.
  template <class Wrap> MS_INLINE PerlinCell(const Vec<N, L>& p, Wrap wrap) {
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i) {
      L cell = floor(p[i]);
      place[i] = p[i] - cell;
      fades[i] = fade(place[i]);
      slopes[i] = fade_slope(place[i]);
      corner[i][0] = lattice(wrap(cell, i));
      corner[i][1] = lattice(wrap(cell + constant<L>(1), i));
    }
  }

  template <class T, int Axis = 0> MS_INLINE Vec<K, T> value(UInt32<L> hash, Vec<N, L> d) const {
    if constexpr (Axis == N) {
#pragma clang loop unroll(full)
      for (int i = N; i < 3; ++i)
        hash = permuted(hash);
      Vec<K, T> ramps;
      ramps[0] = perlin_corner<T>(hash, d);
#pragma clang loop unroll(full)
      for (int k = 1; k < K; ++k)
        ramps[k] = perlin_corner<T>(permuted(hash + UInt32<L>(uint32_t(85 * k))), d);
      return ramps;
    } else {
      Vec<K, T> low = value<T, Axis + 1>(permuted(hash + corner[Axis][0]), d);
      d[Axis] = place[Axis] - constant<L>(1);
      const Vec<K, T> high = value<T, Axis + 1>(permuted(hash + corner[Axis][1]), d);
#pragma clang loop unroll(full)
      for (int k = 0; k < K; ++k)
        low[k] = T::template mix<Axis>(fades[Axis], slopes[Axis], low[k], high[k]);
      return low;
    }
  }
};

/// K noises at a point.
template <int K, class L, int N, class Wrap> MS_INLINE Vec<K, L> perlin_noises(const Vec<N, L>& p, Wrap wrap) {
  using T = typename Interpolated<L, N>::Type;
  const PerlinCell<ValueOf<L>, N, K> cell(value_of(p), wrap);
  const Vec<K, T> values = cell.template value<T>(UInt32<L>(0u), cell.place);
  return [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    return Vec<K, L>{{noise_value(values[I], p)...}};
  }(std::make_index_sequence<K>());
}

struct WithoutPeriod {
  template <class L> MS_INLINE const L& operator()(const L& i, int) const { return i; }
};

template <class L> MS_INLINE L perlin(Vec<4, L> p) { return perlin_noises<1>(p, WithoutPeriod())[0]; }

template <class L, class P> MS_INLINE L pperlin(const P& p, const P& period) {
  const auto lattice = periodic<L>(period);
  return perlin_noises<1>(as_vector(p), [&](const ValueOf<L>& i, int axis) __attribute__((always_inline)) {
    return wrapped(i, lattice.period[axis]);
  })[0];
}

template <class L, class P> MS_INLINE Vec<3, L> vperlin(const P& p) {
  return perlin_noises<3>(as_vector(p), WithoutPeriod());
}

} // namespace moonshade::stdlib
