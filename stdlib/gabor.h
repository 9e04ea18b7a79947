// Gabor noise by sparse convolution (Lagae, Lefebvre, Drettakis, Dutre, "Procedural noise using sparse Gabor
// convolution", SIGGRAPH 2009; random phases after Lagae and Drettakis, "Filtering solid Gabor noise", 2011): the sum
// of wave packets at random points, so its frequency, and where wanted its direction, is chosen exactly.
//
// Each unit cell has 6, 4, 3 packets in 1, 2, 3 dimensions, at random places: (1 - r^2)^3 cos(2 pi (w.r + phase))
// within the distance 1, w being the wave vector: of the given length in a random direction for each packet, or given.
// Twice continuously differentiable (the cosine is a polynomial with error 1e-7). Mean 0, standard deviation 1/3;
// beyond -1..1 in a few of a thousand points, never beyond -8..8. Sharp bands want a frequency of at least 2. NaN and
// infinity give NaN; cells as for `noise`.
#pragma once

#include "stdlib/value_noise.h"

namespace moonshade::stdlib {

/// cos(2 pi t) for |t| < 2^22 in float: the sine of the distance to a quarter, odd Taylor polynomial of degree 13.
template <class L> MS_INLINE L cosine_of_turns(L t) {
  L s = constant<L>(0.25) - abs(t - floor(t + constant<L>(0.5))), q = s * s;
  L sum = constant<L>(3.8199525848482803);
  sum = madd(sum, q, -15.094642576822984);
  sum = madd(sum, q, 42.058693944897634);
  sum = madd(sum, q, -76.70585975306136);
  sum = madd(sum, q, 81.60524927607504);
  sum = madd(sum, q, -41.341702240399755);
  sum = madd(sum, q, 6.283185307179586);
  return s * sum;
}

/// A direction drawn evenly from two numbers in 0..1.
template <int N, class L> MS_INLINE Vec<N, L> random_direction(L a, L b) {
  if constexpr (N == 1) return {{constant<L>(1)}};
  L x = cosine_of_turns(a), y = cosine_of_turns(a - constant<L>(0.25));
  if constexpr (N == 2) return {{x, y}};
  if constexpr (N == 3) {
    L z = b + b - constant<L>(1), r = sqrt(max(nmadd(z, z, constant<L>(1)), constant<L>(0)));
    return {{x * r, y * r, z}};
  }
}

/// Wave vectors: all the same, or of one length in random directions.
template <int N, class L> struct OneWave {
  Vec<N, L> wave;
  MS_INLINE Vec<N, L> of(ValueOf<L>, ValueOf<L>) const { return wave; }
};
template <int N, class L> struct AnyDirection {
  L frequency;
  MS_INLINE Vec<N, L> of(ValueOf<L> a, ValueOf<L> b) const {
    return map<N, L>([&](ValueOf<L> x) __attribute__((always_inline)) { return constant_of<L>(x) * frequency; },
                     random_direction<N>(a, b));
  }
};

/// Packets in a cell, and 1 / (3 standard deviations): the variance is packets/2 times the integral of (1 - r^2)^6,
/// which is 0.68192, pi/7, 0.28567 in 1, 2, 3 dimensions.
template <int N> inline constexpr int kPackets = N == 1 ? 6 : N == 2 ? 4 : 3;
template <int N> inline constexpr double kGaborScale = N == 1 ? 0.23306 : N == 2 ? 0.35183 : 0.50922;

template <class L, int N, class Lattice, class Waves>
MS_INLINE L gabor_noise(const Vec<N, L>& p, const Lattice& lattice, const Waves& waves) {
  using P = ValueOf<L>;
  using U = UInt32<P>;
  const Vec<N, P> at = value_of(p);
  const Vec<N, P> cell = map<N, P>([](P x) __attribute__((always_inline)) { return floor(x); }, at), place = at - cell;
  L sum = joined(constant<L>(0), p, waves.of(constant<P>(0), constant<P>(0)));
  constexpr int cells = N == 1 ? 3 : N == 2 ? 9 : 27;
  for (int c = 0; c < cells; ++c) {
    U hash = U(0u);
    Vec<N, P> corner;
    for (int i = 0, rest = c; i < N; ++i, rest /= 3) {
      const int step = rest % 3 - 1;
      hash ^= lattice.at(cell[i], i, step);
      corner[i] = constant<P>(step) - place[i];
    }
    hash = lattice_hash(hash);
    for (int packet = 0; packet < kPackets<N>; ++packet) {
      U where = mix_bits(hash + U(uint32_t(packet) * 0x9e3779b9u)), what = mix_bits(where + U(0x7f4a7c15u));
      Vec<N, P> way;
      for (int i = 0; i < N; ++i)
        way[i] = madd(convert<P>(bit_cast<Int32<P>>((where >> uint32_t(10 * i)) & U(1023u))), 1.0 / 1024,
                      corner[i] + constant<P>(0.5 / 1024));
      P reach = constant<P>(1);
      for (int i = 0; i < N; ++i)
        reach = nmadd(way[i], way[i], reach);
      if (!any(less(constant<P>(0), reach))) continue;
      const auto unit = [&](int shift) __attribute__((always_inline)) {
        return convert<P>(bit_cast<Int32<P>>((what >> uint32_t(shift)) & U(1023u))) * constant<P>(1.0 / 1024);
      };
      const Vec<N, L> wave = waves.of(unit(0), unit(10)), to = way_from(p, way);
      L turns = constant_of<L>(unit(20)), left = constant<L>(1);
      for (int i = 0; i < N; ++i) {
        turns = madd(wave[i], to[i], turns);
        left = nmadd(to[i], to[i], left);
      }
      left = max(left, constant<L>(0));
      sum = select(less(constant<P>(0), reach), madd(left * left * left, cosine_of_turns(turns), sum), sum);
    }
  }
  P defined = place[0]; // NaN where any coordinate is NaN or infinite
  for (int i = 1; i < N; ++i)
    defined = defined + place[i];
  return select(is_nan(defined), constant<L>(__builtin_nan("")), sum * constant<L>(kGaborScale<N>));
}

template <class L, class P> MS_INLINE L gabor(const P& p, const L& frequency) {
  return gabor_noise<L>(as_vector(p), Endless(), AnyDirection<dimensions_of<P>, L>{frequency});
}
template <class L, int N> MS_INLINE L gabor(const Vec<N, L>& p, const Vec<N, L>& wave) {
  return gabor_noise<L>(p, Endless(), OneWave<N, L>{wave});
}
template <class L, class P> MS_INLINE L pgabor(const P& p, const P& period, const L& frequency) {
  return gabor_noise<L>(as_vector(p), periodic<L>(period), AnyDirection<dimensions_of<P>, L>{frequency});
}

} // namespace moonshade::stdlib
