// Simplex noise, the library's `noise`, in 1 to 4 dimensions; `vnoise`, three of it at once.
//
// Simplex noise (Perlin 2001; Gustavson, "Simplex noise demystified", 2005): space is cut into simplices by skewing the
// integer lattice; each corner within reach adds a gradient ramp under the kernel (1/2 - d^2)^4, which vanishes with
// three derivatives before the next simplex begins, so the noise is twice continuously differentiable. Gradients come
// from a hash of the corner (hash.h), by sign flips and choices instead of a table: the twelve edges of a cube in 3-D,
// the 32 of a tesseract in 4-D, eight directions at equal angles in 2-D. The scales bring the greatest sum over all
// choices of gradients to 1.
//
// Defined everywhere. Coordinates to about 2^22 (float) or 2^50 (double) have their own cells; beyond, the value means
// nothing but is the same at every width. NaN and infinity give NaN.
#pragma once

#include "stdlib/dual.h"
#include "stdlib/hash.h"
#include "stdlib/lattice.h"
#include "stdlib/numbers.h"
#include "stdlib/vec.h"

namespace moonshade::stdlib {

// Ramps: `at` gives the value at a distance from the corner. Scaled is a weight times the ramp: `at` gives its value,
// and a Gradients adds up scaled ones, each times one number more. (Adding begins at -0, which changes no addend.)

/// The ramp x m, m in -1 .. 1.
template <class L> struct Ramp1 {
  L slope;
  MS_INLINE explicit Ramp1(UInt32<L> hash)
      : slope(madd(convert<L>(convert<Int32<L>>(hash >> UInt32<L>(24u))), 2.0 / 255, constant<L>(-1))) {}
  MS_INLINE L at(Vec<1, L> d) const { return d[0] * slope; }

  struct Scaled {
    L slope;
    MS_INLINE Scaled(const Ramp1& ramp, L weight) : slope(weight * ramp.slope) {}
    MS_INLINE L at(Vec<1, L> d) const { return d[0] * slope; }
  };
  struct Gradients {
    L x = constant<L>(-0.0);
    MS_INLINE void add(L times, const Scaled& scaled) { x = madd(times, scaled.slope, x); }
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

  struct Scaled {
    L x, y;
    MS_INLINE Scaled(const Ramp2& ramp, L weight) {
      L u = flip_sign(weight, ramp.sign), v = flip_sign(weight * constant<L>(kShort), ramp.short_sign);
      x = select(ramp.swap, v, u);
      y = select(ramp.swap, u, v);
    }
    MS_INLINE L at(Vec<2, L> d) const { return madd(d[1], y, d[0] * x); }
  };
  struct Gradients {
    L x = constant<L>(-0.0), y = x;
    MS_INLINE void add(L times, const Scaled& scaled) {
      x = madd(times, scaled.x, x);
      y = madd(times, scaled.y, y);
    }
    MS_INLINE Vec<2, L> sum() const { return {{x, y}}; }
  };
};

/// One of a cube's twelve edges: two of the three components, with either signs. The upper bit of the hash and one
/// further down give the signs, the others which components.
template <class L> struct Ramp3 {
  Mask<L> first_is_x, second_is_y;
  Bits<L> first_sign, second_sign;
  MS_INLINE explicit Ramp3(UInt32<L> hash) : first_sign(sign_from<L>(hash)), second_sign(sign_from_bit<L>(hash, 22)) {
    Int32<L> place = convert<Int32<L>>(hash & UInt32<L>(0x7fffffffu));
    first_is_x = to_mask<L>(place > Int32<L>(0x2aaaaaaa));
    second_is_y = to_mask<L>(place > Int32<L>(0x55555554));
  }
  /// Along the edge.
  MS_INLINE Vec<2, L> components(const Vec<3, L>& d) const {
    return {{select(first_is_x, d[0], d[1]), select(second_is_y, d[1], d[2])}};
  }
  MS_INLINE L at(const Vec<3, L>& d) const {
    const Vec<2, L> along = components(d);
    return flip_sign(along[0], first_sign) + flip_sign(along[1], second_sign);
  }

  struct Scaled {
    const Ramp3& ramp;
    L first, second;
    MS_INLINE Scaled(const Ramp3& of, L weight)
        : ramp(of), first(flip_sign(weight, of.first_sign)), second(flip_sign(weight, of.second_sign)) {}
    MS_INLINE L at(const Vec<3, L>& d) const {
      const Vec<2, L> along = ramp.components(d);
      return madd(along[1], second, along[0] * first);
    }
  };
  /// All firsts, those along x, all seconds, those along y: what masked additions do best, with the masks that
  /// processors compare to.
  struct Gradients {
    L first = constant<L>(-0.0), x = first, second = first, y = first;
    MS_INLINE void add(L times, const Scaled& scaled) {
      first = madd(times, scaled.first, first);
      x = select(scaled.ramp.first_is_x, madd(times, scaled.first, x), x);
      second = madd(times, scaled.second, second);
      y = select(scaled.ramp.second_is_y, madd(times, scaled.second, y), y);
    }
    MS_INLINE Vec<3, L> sum() const { return {{x, (first - x) + y, second - y}}; }
  };
};

/// One of a tesseract's 32 edges: all components but one, with any signs.
template <class L> struct Ramp4 {
  Mask<L> not_x, not_w, upper; ///< upper: z or w is left out
  Bits<L> sign[3];
  MS_INLINE explicit Ramp4(UInt32<L> hash)
      : upper(hash_bit<L>(hash, 28)), sign{sign_from<L>(hash), sign_from_bit<L>(hash, 30), sign_from_bit<L>(hash, 29)} {
    auto odd = hash_bit<L>(hash, 27);
    not_x = !upper & !odd;
    not_w = upper & odd;
  }
  /// Along the edge.
  MS_INLINE Vec<3, L> components(const Vec<4, L>& d) const {
    return {{select(not_x, d[1], d[0]), select(upper, d[1], d[2]), select(not_w, d[2], d[3])}};
  }
  MS_INLINE L at(const Vec<4, L>& d) const {
    const Vec<3, L> along = components(d);
    return flip_sign(along[0], sign[0]) + flip_sign(along[1], sign[1]) + flip_sign(along[2], sign[2]);
  }

  struct Scaled {
    const Ramp4& ramp;
    L first, second, last;
    MS_INLINE Scaled(const Ramp4& of, L weight)
        : ramp(of), first(flip_sign(weight, of.sign[0])), second(flip_sign(weight, of.sign[1])),
          last(flip_sign(weight, of.sign[2])) {}
    MS_INLINE L at(const Vec<4, L>& d) const {
      const Vec<3, L> along = ramp.components(d);
      return madd(along[2], last, madd(along[1], second, along[0] * first));
    }
  };
  struct Gradients {
    L first = constant<L>(-0.0), y = first, z = first, last = first, second = first, third = first;
    MS_INLINE void add(L times, const Scaled& scaled) {
      first = madd(times, scaled.first, first);
      y = select(scaled.ramp.not_x, madd(times, scaled.first, y), y); // those of the firsts along y
      second = madd(times, scaled.second, second);
      third = select(scaled.ramp.upper, madd(times, scaled.second, third), third); // those of the seconds along y
      last = madd(times, scaled.last, last);
      z = select(scaled.ramp.not_w, madd(times, scaled.last, z), z); // those of the lasts along z
    }
    MS_INLINE Vec<4, L> sum() const { return {{first - y, y + third, (second - third) + z, last - z}}; }
  };
};

template <class L, int N>
using Ramp = std::conditional_t<N <= 2, std::conditional_t<N == 1, Ramp1<L>, Ramp2<L>>,
                                std::conditional_t<N == 3, Ramp3<L>, Ramp4<L>>>;

// What the corners add up to ------------------------------------------------------------------------------------------

/// The sum of t^4 ramp(d), t being the kernel's root, alone.
template <class L, int N> struct Sum {
  L value = constant<L>(0);
  MS_INLINE void add(L t, const Vec<N, L>& d, const Ramp<L, N>& ramp) {
    L square = t * t;
    value = madd(square * square, ramp.at(d), value);
  }
};
/// The sum with its gradient by the point: the distances d from the corners move as the point does, so the gradient of
/// t^4 ramp(d) with t = reach - d^2 is t^4 ramp' - 8 t^3 ramp(d) d, of which t^3 ramp is made first.
template <class L, int N> struct SumWithGradient : Sum<L, N> {
  typename Ramp<L, N>::Gradients rises;
  Vec<N, L> falls = map<N, L>([](L x) __attribute__((always_inline)) { return x; }, constant<L>(-0.0));
  MS_INLINE void add(L t, const Vec<N, L>& d, const Ramp<L, N>& ramp) {
    Sum<L, N>::add(t, d, ramp);
    typename Ramp<L, N>::Scaled scaled(ramp, t * t * t);
    rises.add(t, scaled);
    falls = madd(d, scaled.at(d), falls);
  }
  /// The gradient times a number.
  MS_INLINE Vec<N, L> gradient(double scale) const {
    return madd(falls, constant<L>(-8 * scale), rises.sum() * constant<L>(scale));
  }
};

/// Three sums at once, with gradients of their own at each corner.
template <class S> struct Three {
  S each[3];
};

/// max(t, 0), t being the square of the reach less d^2.
template <class L, int N> MS_INLINE L kernel_root(const Vec<N, L>& d, double reach) {
  L t = constant<L>(reach);
#pragma clang loop unroll(full)
  for (int i = 0; i < N; ++i)
    t = nmadd(d[i], d[i], t);
  return max(t, constant<L>(0));
}

template <class L, int N, class S> MS_INLINE void add_corner(UInt32<L> hash, const Vec<N, L>& d, double reach, S& sum) {
  sum.add(kernel_root(d, reach), d, Ramp<L, N>(hash));
}
template <class L, int N, class S>
MS_INLINE void add_corner(UInt32<L> hash, const Vec<N, L>& d, double reach, Three<S>& sum) {
  L t = kernel_root(d, reach);
#pragma clang loop unroll(full)
  for (int which = 0; which < 3; ++which)
    sum.each[which].add(t, d, Ramp<L, N>(other_hash(hash, which)));
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

template <class L, class S> MS_INLINE void add_noise(Vec<4, L> p, S& sum) {
  using U = UInt32<L>;
  constexpr double skew = 0x1.3c6ef372fe95p-2;    // (sqrt 5 - 1) / 4
  constexpr double unskew = 0x1.1b06d1d200913p-3; // (5 - sqrt 5) / 20
  L s = (p[0] + p[1]) + (p[2] + p[3]);
  L i[4], t = constant<L>(0);
  U low[4], high[4];
  Vec<4, L> d;
#pragma clang loop unroll(full)
  for (int a = 0; a < 4; ++a) {
    i[a] = floor(madd(s, skew, p[a]));
    t = t + i[a];
    low[a] = lattice(i[a]) * kLatticePrimes[a];
    high[a] = low[a] + kLatticePrimes[a];
  }
#pragma clang loop unroll(full)
  for (int a = 0; a < 4; ++a)
    d[a] = madd(t, unskew, p[a] - i[a]);

  // How many of the others each coordinate precedes: corner n goes along those that precede at least 4 - n.
  U rank[4] = {U(0u), U(0u), U(0u), U(0u)};
#pragma clang loop unroll(full)
  for (int a = 0; a < 4; ++a)
#pragma clang loop unroll(full)
    for (int b = a + 1; b < 4; ++b) {
      auto precedes = less_equal(d[b], d[a]);
      rank[a] = select(precedes, rank[a] + 1u, rank[a]);
      rank[b] = select(precedes, rank[b], rank[b] + 1u);
    }
  // A loop: unrolled it would be much code for little speed.
#pragma clang loop unroll(disable)
  for (uint32_t n = 0; n < 5; ++n) {
    U hash = U(0u);
    Vec<4, L> to;
#pragma clang loop unroll(full)
    for (int a = 0; a < 4; ++a) {
      auto along = to_mask<L>(rank[a] >= U(4 - n));
      hash ^= select(along, high[a], low[a]);
      to[a] = d[a] + select(along, constant<L>(n * unskew - 1), constant<L>(n * unskew));
    }
    add_corner<L>(lattice_hash(hash), to, 0.5, sum);
  }
}

// The noise -----------------------------------------------------------------------------------------------------------

/// By dimensions: 1 / greatest sum, which is 0.31640625 (at 1/2), 0.0108195832768, 0.0130071571829, 0.015929221459.
template <int N> inline constexpr double kNoiseScale = N == 1 ? 3.16 : N == 2 ? 92.42 : N == 3 ? 76.88 : 62.77;

template <class L, int N> MS_INLINE L noise(Vec<N, L> p) {
  Sum<L, N> sum;
  add_noise<L>(p, sum);
  return sum.value * constant<L>(kNoiseScale<N>);
}
template <class L> MS_INLINE L noise(L x) { return noise<L>(Vec<1, L>{{x}}); }

template <DualLane D, int N> MS_INLINE D noise(Vec<N, D> p) {
  using L = typename D::Lane;
  SumWithGradient<L, N> sum;
  add_noise<L>(value_of(p), sum);
  return chain<D>(sum.value * constant<L>(kNoiseScale<N>), p, sum.gradient(kNoiseScale<N>));
}

/// Three noises, of which the first is `noise`.
template <class L, int N> MS_INLINE Vec<3, L> vnoise(Vec<N, L> p) {
  Three<Sum<L, N>> sum;
  add_noise<L>(p, sum);
  L scale = constant<L>(kNoiseScale<N>);
  return {{sum.each[0].value * scale, sum.each[1].value * scale, sum.each[2].value * scale}};
}
template <DualLane D, int N> MS_INLINE Vec<3, D> vnoise(Vec<N, D> p) {
  using L = typename D::Lane;
  Three<SumWithGradient<L, N>> sum;
  add_noise<L>(value_of(p), sum);
  const auto component = [&](int i) __attribute__((always_inline)) {
    return chain<D>(sum.each[i].value * constant<L>(kNoiseScale<N>), p, sum.each[i].gradient(kNoiseScale<N>));
  };
  return {{component(0), component(1), component(2)}};
}
template <class L> MS_INLINE Vec<3, L> vnoise(L x) { return vnoise<L>(Vec<1, L>{{x}}); }

} // namespace moonshade::stdlib
