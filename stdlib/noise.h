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

#include "stdlib/hash.h"
#include "stdlib/numbers.h"
#include "stdlib/vec.h"

namespace moonshade::stdlib {

/// max(1/2 - d^2, 0)^4 times the ramp; d^2 is subtracted term by term.
template <class L> MS_INLINE L kernel(L t, L ramp, L sum) {
  t = max(t, constant<L>(0));
  t = t * t;
  return madd(t * t, ramp, sum);
}

/// The sign bit of a number, taken from bit 31 of the hash.
template <class L> MS_INLINE Bits<L> sign_from(UInt32<L> hash) {
  if constexpr (is_f32<L>)
    return hash & UInt32<L>(0x80000000u);
  else
    return convert<Bits<L>>(hash & UInt32<L>(0x80000000u)) << Bits<L>(uint64_t(32));
}

/// A ramp with slope -1 .. 1, in 256 steps.
template <class L> MS_INLINE L ramp(UInt32<L> hash, L x) {
  return x * madd(convert<L>(convert<Int32<L>>(hash >> UInt32<L>(24u))), 2.0 / 255, constant<L>(-1));
}

/// A bit of the hash as a mask. (Shifts of the hash to the left would be made multiplications by the optimiser.)
template <class L> MS_INLINE Mask<L> hash_bit(UInt32<L> hash, int bit) {
  return to_mask<L>((hash & UInt32<L>(uint32_t(1) << bit)) != UInt32<L>(0u));
}

/// One of eight directions: (1, sqrt 2 - 1), either way round, with either signs.
template <class L> MS_INLINE L ramp(UInt32<L> hash, Vec<2, L> d) {
  auto swap = hash_bit<L>(hash, 29);
  L u = select(swap, d[1], d[0]), v = select(swap, d[0], d[1]);
  return madd(select(hash_bit<L>(hash, 30), -v, v), 0x1.a827999fcef32p-2, flip_sign(u, sign_from<L>(hash)));
}

/// One of a cube's twelve edges: two of the three components, with either signs. The upper bit of the hash and one
/// further down give the signs, the others which components.
template <class L> MS_INLINE L ramp(UInt32<L> hash, Vec<3, L> d) {
  Int32<L> place = convert<Int32<L>>(hash & UInt32<L>(0x7fffffffu));
  L u = select(to_mask<L>(place < Int32<L>(0x2aaaaaab)), d[1], d[0]);
  L v = select(to_mask<L>(place < Int32<L>(0x55555555)), d[2], d[1]);
  return flip_sign(u, sign_from<L>(hash)) + select(hash_bit<L>(hash, 22), -v, v);
}

/// In one dimension the corners are the integers and the kernel is (1 - d^2)^4.
template <class L> MS_INLINE L noise(L x) {
  L i = floor(x), one = constant<L>(1);
  L d0 = x - i, d1 = d0 - one;
  UInt32<L> u = lattice(i) * kLatticePrimes[0];
  L sum = kernel(nmadd(d0, d0, one), ramp(mix_bits(u), d0), constant<L>(0));
  sum = kernel(nmadd(d1, d1, one), ramp(mix_bits(u + kLatticePrimes[0]), d1), sum);
  return sum * constant<L>(3.16); // greatest sum 0.31640625, at 1/2
}

template <class L> MS_INLINE L corner(UInt32<L> hash, Vec<2, L> d, L sum) {
  L t = nmadd(d[1], d[1], nmadd(d[0], d[0], constant<L>(0.5)));
  return kernel(t, ramp<L>(lattice_hash(hash), d), sum);
}
template <class L> MS_INLINE L corner(UInt32<L> hash, Vec<3, L> d, L sum) {
  L t = nmadd(d[2], d[2], nmadd(d[1], d[1], nmadd(d[0], d[0], constant<L>(0.5))));
  return kernel(t, ramp<L>(lattice_hash(hash), d), sum);
}

template <class L> MS_INLINE L noise(Vec<2, L> p) {
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
  L sum = corner<L>(hi ^ hj, Vec<2, L>{{x, y}}, constant<L>(0));
  sum = corner<L>(select(lower, hi1, hi) ^ select(lower, hj, hj1),
                  Vec<2, L>{{select(lower, xg - one, xg), select(lower, yg, yg - one)}}, sum);
  L last = constant<L>(2 * unskew - 1);
  sum = corner<L>(hi1 ^ hj1, Vec<2, L>{{x + last, y + last}}, sum);
  return sum * constant<L>(92.42); // greatest sum 0.0108195832768
}

template <class L> MS_INLINE L noise(Vec<3, L> p) {
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
  L sum = corner<L>(hi ^ hj ^ hk, Vec<3, L>{{x, y, z}}, constant<L>(0));
  sum = corner<L>(
      select(first_x, hi1, hi) ^ select(first_y, hj1, hj) ^ select(first_z, hk1, hk),
      Vec<3, L>{{select(first_x, x1 - one, x1), select(first_y, y1 - one, y1), select(first_z, z1 - one, z1)}}, sum);
  sum = corner<L>(
      select(second_x, hi1, hi) ^ select(second_y, hj1, hj) ^ select(second_z, hk1, hk),
      Vec<3, L>{{select(second_x, x2 - one, x2), select(second_y, y2 - one, y2), select(second_z, z2 - one, z2)}}, sum);
  sum = corner<L>(hi1 ^ hj1 ^ hk1, Vec<3, L>{{x - half, y - half, z - half}}, sum);
  return sum * constant<L>(76.88); // greatest sum 0.0130071571829
}

} // namespace moonshade::stdlib
