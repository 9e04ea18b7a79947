// `pnoise`: simplex noise that repeats after a whole number of units along each axis.
//
// The lattice of `noise` repeats in no direction of the axes, so this one takes lattices that do. In 3-D it is the same
// lattice turned: the points whose coordinates are all integers or all halves (body-centred cubic), cut into the same
// tetrahedra (Gustavson and McEwan, "Tiling simplex noise and flow noise in two and three dimensions", JCGT 2022), with
// kernel and gradients of `noise`; in 2-D a slice of that, half way between two layers of lattice points (of the
// plane's lattices that repeat at all integers none is near enough to equilateral); in 1-D the integers. In 4-D it is
// again the integers and the halves together (the lattice D4*), each point under the kernel (3/4 - d^2)^4, summed over
// the 32 corners of the two unit cells around the point.
//
// -1..1, twice continuously differentiable. Defined and NaN as `noise` is.
#pragma once

#include "stdlib/noise.h"
#include "stdlib/value_noise.h"

namespace moonshade::stdlib {

template <class L, class S>
MS_INLINE void add_periodic_noise(const Vec<1, L>& p, const Periodic<1, L>& lattice, S& sum) {
  L i = floor(p[0]), d = p[0] - i;
  add_corner<L>(mix_bits(lattice.at(i, 0, 0)), Vec<1, L>{{d}}, 1, sum);
  add_corner<L>(mix_bits(lattice.at(i, 0, 1)), Vec<1, L>{{d - constant<L>(1)}}, 1, sum);
}

/// A coordinate of lattice points in halves, modulo twice the period.
template <class L> struct HalfAxis {
  L first, period;
  int axis;

  MS_INLINE HalfAxis(L halves, L units, int axis)
      : first(wrapped(halves, units + units)), period(units + units), axis(axis) {}
  /// The hash's part for a step of -1, 0 or 1 from the first.
  MS_INLINE UInt32<L> at(L step) const {
    L i = first + step;
    i = select(less(i, constant<L>(0)), i + period, select(less(i, period), i, i - period));
    return lattice(i) * kLatticePrimes[axis];
  }
};

/// Tetrahedra of the lattice spanned by (-1, 1, 1)/2, (1, -1, 1)/2 and (1, 1, -1)/2: the integer coordinates along
/// these are y + z, x + z and x + y.
template <class L, class S>
MS_INLINE void add_periodic_noise(const Vec<3, L>& p, const Periodic<3, L>& lattice, S& sum) {
  // By the fractions, so that far from the origin sums of coordinates lose nothing.
  const Vec<3, L> whole = map<3, L>([](L x) __attribute__((always_inline)) { return floor(x); }, p), rest = p - whole;
  L u = rest[1] + rest[2], v = rest[0] + rest[2], w = rest[0] + rest[1];
  L i = floor(u), j = floor(v), k = floor(w), half = constant<L>(0.5), one = constant<L>(1);
  L a = u - i, b = v - j, c = w - k;
  const HalfAxis<L> axes[3] = {{madd(whole[0], 2.0, j + k - i), lattice.period[0], 0},
                               {madd(whole[1], 2.0, i + k - j), lattice.period[1], 1},
                               {madd(whole[2], 2.0, i + j - k), lattice.period[2], 2}};
  const Vec<3, L> d = {{(b + c - a) * half, (a + c - b) * half, (a + b - c) * half}};

  // A corner by its steps in halves.
  const auto corner = [&](L x, L y, L z) __attribute__((always_inline)) {
    UInt32<L> hash = axes[0].at(x) ^ axes[1].at(y) ^ axes[2].at(z);
    add_corner<L>(lattice_hash(hash), Vec<3, L>{{nmadd(x, 0.5, d[0]), nmadd(y, 0.5, d[1]), nmadd(z, 0.5, d[2])}}, 0.5,
                  sum);
  };
  auto ab = less_equal(b, a), bc = less_equal(c, b), ac = less_equal(c, a);
  auto first_a = ab & ac, first_b = !ab & bc, first_c = !ac & !bc; // the greatest: the second corner lies along it
  auto last_a = !ab & !ac, last_b = ab & !bc, last_c = ac & bc;    // the least: the third lies along both others
  L zero = constant<L>(0), two = constant<L>(2);
  const auto one_way = [&](Mask<L> mask) __attribute__((always_inline)) { return select(mask, -one, one); };
  const auto two_ways = [&](Mask<L> mask) __attribute__((always_inline)) { return select(mask, two, zero); };
  corner(zero, zero, zero);
  corner(one_way(first_a), one_way(first_b), one_way(first_c));
  corner(two_ways(last_a), two_ways(last_b), two_ways(last_c));
  corner(one, one, one);
}

template <class L, class S>
MS_INLINE void add_periodic_noise(const Vec<4, L>& p, const Periodic<4, L>& lattice, S& sum) {
  using U = UInt32<L>;
  for (int halves = 0; halves < 2; ++halves) {
    U part[4][2];
    Vec<4, L> place;
#pragma clang loop unroll(full)
    for (int i = 0; i < 4; ++i) {
      L x = p[i] - constant<L>(0.5 * halves), cell = floor(x);
      place[i] = x - cell;
      part[i][0] = lattice.at(cell, i, 0);
      part[i][1] = lattice.at(cell, i, 1);
    }
    for (unsigned corner = 0; corner < 16; ++corner) {
      U hash = U(halves * 0x9e3779b9u);
      Vec<4, L> d;
#pragma clang loop unroll(full)
      for (int i = 0; i < 4; ++i) {
        const unsigned up = corner >> i & 1;
        hash ^= part[i][up];
        d[i] = place[i] - constant<L>(up);
      }
      add_corner<L>(lattice_hash(hash), d, 0.75, sum);
    }
  }
}

/// By dimensions: 1 / greatest sum, as kNoiseScale (in 2-D of the slice, 0.0119143739542; in 4-D 0.101245293569).
template <int N> inline constexpr double kPeriodicScale = N == 2 ? 83.93 : N == 4 ? 9.877 : kNoiseScale<N>;

/// In 2-D the slice at z = 1/4, with period 1 along z.
template <class L, int N> MS_INLINE auto periodic_space(const Vec<N, L>& p, double third) {
  if constexpr (N == 2)
    return Vec<3, L>{{p[0], p[1], constant<L>(third)}};
  else
    return p;
}

template <class L, int N> MS_INLINE L periodic_noise(const Vec<N, L>& p, const Vec<N, L>& period) {
  Sum<L, N == 2 ? 3 : N> sum;
  add_periodic_noise(periodic_space(p, 0.25), Periodic < N == 2 ? 3 : N, L > (periodic_space(period, 1)), sum);
  return sum.value * constant<L>(kPeriodicScale<N>);
}
template <DualLane D, int N> MS_INLINE D periodic_noise(const Vec<N, D>& p, const Vec<N, D>& period) {
  using L = typename D::Lane;
  SumWithGradient<L, N == 2 ? 3 : N> sum;
  add_periodic_noise(periodic_space(value_of(p), 0.25), Periodic < N == 2 ? 3 : N,
                     L > (periodic_space(value_of(period), 1)), sum);
  return chain<D>(sum.value * constant<L>(kPeriodicScale<N>), periodic_space(p, 0.25), sum.gradient(kPeriodicScale<N>));
}

template <class L, class P> MS_INLINE L pnoise(const P& p, const P& period) {
  return periodic_noise(as_vector(p), as_vector(period));
}

} // namespace moonshade::stdlib
