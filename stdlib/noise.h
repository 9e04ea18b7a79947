// Simplex noise, the library's `noise`.
//
// Simplex noise (Perlin 2001; Gustavson, "Simplex noise demystified", 2005): space is cut into simplices by skewing the
// integer lattice; each corner within reach adds a gradient ramp under the kernel (1/2 - d^2)^4, which vanishes with
// three derivatives before the next simplex begins, so the noise is twice continuously differentiable. Gradients come
// from a hash of the corner (hash.h), by sign flips and choices instead of a table: the twelve edges of a cube in 3-D,
// eight directions at equal angles in 2-D. The scales bring the greatest sum over all choices of gradients to 1.
//
// Defined everywhere. Coordinates to about 2^22 (float) or 2^50 (double) have their own cells; beyond, the value means
// nothing but is the same at every width. NaN and infinity give NaN.
#pragma once

#include "stdlib/dual.h"
#include "stdlib/hash.h"
#include "stdlib/numbers.h"
#include "stdlib/vec.h"

namespace moonshade::stdlib {

/// The sign bit of a number, taken from bit 31 of the hash.
template <class L> MS_INLINE Bits<L> sign_from(UInt32<L> hash) {
  if constexpr (is_f32<L>)
    return hash & UInt32<L>(0x80000000u);
  else
    return convert<Bits<L>>(hash & UInt32<L>(0x80000000u)) << Bits<L>(uint64_t(32));
}

/// A bit of the hash as a mask. (Shifts of the hash to the left would be made multiplications by the optimiser.)
template <class L> MS_INLINE Mask<L> hash_bit(UInt32<L> hash, int bit) {
  return to_mask<L>((hash & UInt32<L>(uint32_t(1) << bit)) != UInt32<L>(0u));
}

/// The same from another bit.
template <class L> MS_INLINE Bits<L> sign_from_bit(UInt32<L> hash, int bit) {
  return select(hash_bit<L>(hash, bit), sign_bit<L>(), Bits<L>(0));
}

// Ramps: `at` gives the value at a distance from the corner; a Gradients adds up gradients, each times a weight.

/// The ramp x m, m in -1 .. 1.
template <class L> struct Ramp1 {
  L slope;
  MS_INLINE explicit Ramp1(UInt32<L> hash)
      : slope(madd(convert<L>(convert<Int32<L>>(hash >> UInt32<L>(24u))), 2.0 / 255, constant<L>(-1))) {}
  MS_INLINE L at(Vec<1, L> d) const { return d[0] * slope; }

  struct Gradients {
    L x = constant<L>(0);
    MS_INLINE void add(L weight, const Ramp1& ramp) { x = madd(weight, ramp.slope, x); }
    MS_INLINE Vec<1, L> sum() const { return {{x}}; }
  };
};

/// One of eight directions: (1, sqrt 2 - 1), either way round, with either signs.
template <class L> struct Ramp2 {
  static constexpr double kShort = 0x1.a827999fcef32p-2;
  Mask<L> swap;
  Bits<L> sign, short_sign;
  MS_INLINE explicit Ramp2(UInt32<L> hash)
      : swap(hash_bit<L>(hash, 29)), sign(sign_from<L>(hash)), short_sign(sign_from_bit<L>(hash, 30)) {}
  MS_INLINE L at(Vec<2, L> d) const {
    L u = select(swap, d[1], d[0]), v = select(swap, d[0], d[1]);
    return madd(flip_sign(v, short_sign), kShort, flip_sign(u, sign));
  }

  struct Gradients {
    L x = constant<L>(0), y = x;
    MS_INLINE void add(L weight, const Ramp2& ramp) {
      L u = flip_sign(weight, ramp.sign), v = flip_sign(weight * constant<L>(kShort), ramp.short_sign);
      x = x + select(ramp.swap, v, u);
      y = y + select(ramp.swap, u, v);
    }
    MS_INLINE Vec<2, L> sum() const { return {{x, y}}; }
  };
};

/// One of a cube's twelve edges: two of the three components, with either signs. The upper bit of the hash and one
/// further down give the signs, the others which components.
template <class L> struct Ramp3 {
  Mask<L> first_is_y, second_is_z;
  Bits<L> first_sign, second_sign;
  MS_INLINE explicit Ramp3(UInt32<L> hash) : first_sign(sign_from<L>(hash)), second_sign(sign_from_bit<L>(hash, 22)) {
    Int32<L> place = convert<Int32<L>>(hash & UInt32<L>(0x7fffffffu));
    first_is_y = to_mask<L>(place < Int32<L>(0x2aaaaaab));
    second_is_z = to_mask<L>(place < Int32<L>(0x55555555));
  }
  MS_INLINE L at(Vec<3, L> d) const {
    L u = select(first_is_y, d[1], d[0]), v = select(second_is_z, d[2], d[1]);
    return flip_sign(u, first_sign) + flip_sign(v, second_sign);
  }

  /// All firsts, those along y, all seconds, those along z: what masked additions do best.
  struct Gradients {
    L first = constant<L>(0), y = first, second = first, z = first;
    MS_INLINE void add(L weight, const Ramp3& ramp) {
      L u = flip_sign(weight, ramp.first_sign), v = flip_sign(weight, ramp.second_sign);
      first = first + u;
      y = select(ramp.first_is_y, y + u, y);
      second = second + v;
      z = select(ramp.second_is_z, z + v, z);
    }
    MS_INLINE Vec<3, L> sum() const { return {{first - y, y + (second - z), z}}; }
  };
};

template <class L, int N>
using Ramp = std::conditional_t<N == 1, Ramp1<L>, std::conditional_t<N == 2, Ramp2<L>, Ramp3<L>>>;

// What the corners add up to ------------------------------------------------------------------------------------------

/// The sum alone, or with its gradient by the point: the distances d from the corners move as the point does, so the
/// gradient of t^4 ramp(d) with t = reach - d^2 is t^4 ramp' - 8 t^3 ramp(d) d.
template <class L, int N> struct Sum {
  L value = constant<L>(0);
  MS_INLINE void add(L kernel, L, L height, const Vec<N, L>&, const Ramp<L, N>&) {
    value = madd(kernel, height, value);
  }
};
template <class L, int N> struct SumWithGradient {
  L value = constant<L>(0);
  typename Ramp<L, N>::Gradients rises;
  Vec<N, L> falls = map<N, L>([](L x) __attribute__((always_inline)) { return x; }, constant<L>(0));
  MS_INLINE void add(L kernel, L cube, L height, const Vec<N, L>& d, const Ramp<L, N>& ramp) {
    value = madd(kernel, height, value);
    rises.add(kernel, ramp);
    falls = madd(d, cube * height, falls);
  }
  /// The gradient times a number.
  MS_INLINE Vec<N, L> gradient(double scale) const {
    return madd(falls, constant<L>(-8 * scale), rises.sum() * constant<L>(scale));
  }
};

/// max(t, 0)^4 times the ramp, t being the square of the reach less d^2.
template <class L, int N, class S> MS_INLINE void add_corner(UInt32<L> hash, const Vec<N, L>& d, double reach, S& sum) {
  L t = constant<L>(reach);
#pragma clang loop unroll(full)
  for (int i = 0; i < N; ++i)
    t = nmadd(d[i], d[i], t);
  t = max(t, constant<L>(0));
  L square = t * t;
  Ramp<L, N> ramp(hash);
  sum.add(square * square, square * t, ramp.at(d), d, ramp);
}

/// In one dimension the corners are the integers and the kernel is (1 - d^2)^4.
template <class L, class S> MS_INLINE void add_noise(Vec<1, L> p, S& sum) {
  L i = floor(p[0]), one = constant<L>(1);
  L d0 = p[0] - i, d1 = d0 - one;
  UInt32<L> u = lattice(i) * kLatticePrimes[0];
  add_corner<L>(mix_bits(u), Vec<1, L>{{d0}}, 1, sum);
  add_corner<L>(mix_bits(u + kLatticePrimes[0]), Vec<1, L>{{d1}}, 1, sum);
}

template <class L, class S> MS_INLINE void add_noise(Vec<2, L> p, S& sum) {
  constexpr double skew = 0x1.76cf5d0b09955p-2;   // (sqrt 3 - 1) / 2
  constexpr double unskew = 0x1.b0cb174df99c8p-3; // (3 - sqrt 3) / 6
  using U = UInt32<L>;
  L s = p[0] + p[1];
  L i = floor(madd(s, skew, p[0])), j = floor(madd(s, skew, p[1]));
  L t = i + j;
  L x = madd(t, unskew, p[0] - i), y = madd(t, unskew, p[1] - j);
  U hi = lattice(i) * kLatticePrimes[0], hj = lattice(j) * kLatticePrimes[1];
  U hi1 = hi + kLatticePrimes[0], hj1 = hj + kLatticePrimes[1];

  auto lower = less(y, x); // the triangle: first along x
  L one = constant<L>(1), g = constant<L>(unskew);
  L xg = x + g, yg = y + g;
  const auto corner = [&](U hash, L dx, L dy) __attribute__((always_inline)) {
    add_corner<L>(lattice_hash(hash), Vec<2, L>{{dx, dy}}, 0.5, sum);
  };
  corner(hi ^ hj, x, y);
  corner(select(lower, hi1, hi) ^ select(lower, hj, hj1), select(lower, xg - one, xg), select(lower, yg, yg - one));
  L last = constant<L>(2 * unskew - 1);
  corner(hi1 ^ hj1, x + last, y + last);
}

template <class L, class S> MS_INLINE void add_noise(Vec<3, L> p, S& sum) {
  using U = UInt32<L>;
  L s = p[0] + p[1] + p[2];
  L i = floor(madd(s, 1.0 / 3, p[0])), j = floor(madd(s, 1.0 / 3, p[1])), k = floor(madd(s, 1.0 / 3, p[2]));
  L t = i + j + k;
  L x = madd(t, 1.0 / 6, p[0] - i), y = madd(t, 1.0 / 6, p[1] - j), z = madd(t, 1.0 / 6, p[2] - k);
  U hi = lattice(i) * kLatticePrimes[0], hj = lattice(j) * kLatticePrimes[1], hk = lattice(k) * kLatticePrimes[2];
  U hi1 = hi + kLatticePrimes[0], hj1 = hj + kLatticePrimes[1], hk1 = hk + kLatticePrimes[2];

  // The tetrahedron: its second corner lies along the greatest coordinate, its third along all but the least.
  auto xy = less_equal(y, x), yz = less_equal(z, y), xz = less_equal(z, x);
  auto first_x = xy & xz, first_y = !xy & yz, first_z = !xz & !yz;
  auto second_x = xy | xz, second_y = !xy | yz, second_z = !(xz & yz);

  L one = constant<L>(1), sixth = constant<L>(1.0 / 6), third = constant<L>(1.0 / 3), half = constant<L>(0.5);
  L x1 = x + sixth, y1 = y + sixth, z1 = z + sixth;
  L x2 = x + third, y2 = y + third, z2 = z + third;
  const auto corner = [&](U hash, L dx, L dy, L dz) __attribute__((always_inline)) {
    add_corner<L>(lattice_hash(hash), Vec<3, L>{{dx, dy, dz}}, 0.5, sum);
  };
  corner(hi ^ hj ^ hk, x, y, z);
  corner(select(first_x, hi1, hi) ^ select(first_y, hj1, hj) ^ select(first_z, hk1, hk), select(first_x, x1 - one, x1),
         select(first_y, y1 - one, y1), select(first_z, z1 - one, z1));
  corner(select(second_x, hi1, hi) ^ select(second_y, hj1, hj) ^ select(second_z, hk1, hk),
         select(second_x, x2 - one, x2), select(second_y, y2 - one, y2), select(second_z, z2 - one, z2));
  corner(hi1 ^ hj1 ^ hk1, x - half, y - half, z - half);
}

// The noise -----------------------------------------------------------------------------------------------------------

/// By dimensions: 1 / greatest sum, which is 0.31640625 (at 1/2), 0.0108195832768, 0.0130071571829.
template <int N> inline constexpr double kNoiseScale = N == 1 ? 3.16 : N == 2 ? 92.42 : 76.88;

template <class L, int N> MS_INLINE L noise(Vec<N, L> p) {
  Sum<L, N> sum;
  add_noise<L>(p, sum);
  return sum.value * constant<L>(kNoiseScale<N>);
}
template <class L> MS_INLINE L noise(L x) { return noise<L>(Vec<1, L>{{x}}); }

/// The chain rule from the gradient at the point's value.
template <DualLane D, int N> MS_INLINE D noise(Vec<N, D> p) {
  using L = typename D::Lane;
  SumWithGradient<L, N> sum;
  add_noise<L>(map<N, L>([](const D& x) __attribute__((always_inline)) { return x.v; }, p), sum);
  L value = sum.value * constant<L>(kNoiseScale<N>);
  Vec<N, L> g = sum.gradient(kNoiseScale<N>);
  if constexpr (N == 1) return chain<D>(value, p[0], g[0]);
  if constexpr (N == 2) return chain<D>(value, p[0], g[0], p[1], g[1]);
  if constexpr (N == 3) return chain<D>(value, p[0], g[0], p[1], g[1], p[2], g[2]);
}

} // namespace moonshade::stdlib
