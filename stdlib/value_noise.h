// Noise of values at the points of the integer lattice: `valuenoise`, which runs smoothly from one to the next, and
// `cellnoise`, which keeps each throughout its cell; both in 1 to 4 dimensions, periodic (`p...`) and vector-valued.
//
// Value noise (as in Ebert et al., "Texturing and Modeling", the lattice noise with the fade of Perlin 2002): random
// values in -1..1 interpolated along each axis by 6t^5 - 15t^4 + 10t^3, so it is twice continuously differentiable and
// never leaves -1..1. Its features follow the axes; `noise` is better where that shows, but costs more.
// Cell noise (as OSL's and RenderMan's): a random number in 0..1 for each unit cell, from the floor of the point.
//
// Coordinates to about 2^22 (float) or 2^50 (double) have their own cells; beyond, the value means nothing but is the
// same at every width. NaN and infinity give NaN in valuenoise; in cellnoise they are cells like others.
#pragma once

#include "stdlib/lattice.h"

namespace moonshade::stdlib {

/// A value in -1..1, from all bits of the hash; scaled so that interpolation cannot round above 1.
template <class L> MS_INLINE L lattice_value(UInt32<L> hash) {
  return convert<L>(bit_cast<Int32<L>>(hash)) * constant<L>(0x1.ffffp-32);
}

/// The last step of a lattice point's hash. Along a row of points that differ in one coordinate alone squares go up and
/// down like a parabola: that takes more.
template <int N, class U> MS_INLINE U mixed(U hash) { return N == 1 ? mix_bits(hash) : lattice_hash(hash); }

/// A cell: the hashes of its corners, the place in it, and interpolation over the corners, from the axis `Axis` on.
template <class L, int N> struct ValueCell {
  UInt32<L> parts[N][2];
  Vec<N, L> fades, slopes;

  template <class Lattice> MS_INLINE ValueCell(const Vec<N, L>& p, const Lattice& lattice) {
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i) {
      L cell = floor(p[i]), place = p[i] - cell;
      fades[i] = fade(place);
      slopes[i] = fade_slope(place);
      parts[i][0] = lattice.at(cell, i, 0);
      parts[i][1] = lattice.at(cell, i, 1);
    }
  }
  template <class T, int Axis = 0> MS_INLINE T value(int which, UInt32<L> hash = UInt32<L>(0u)) const {
    if constexpr (Axis == N) {
      return T{lattice_value<L>(other_hash(mixed<N>(hash), which))};
    } else {
      const T low = value<T, Axis + 1>(which, hash ^ parts[Axis][0]),
              high = value<T, Axis + 1>(which, hash ^ parts[Axis][1]);
      return T::template mix<Axis>(fades[Axis], slopes[Axis], low, high);
    }
  }
};

template <class L, int N, class Lattice> MS_INLINE L value_noise(const Vec<N, L>& p, const Lattice& lattice) {
  using T = typename Interpolated<L, N>::Type;
  return noise_value(ValueCell<ValueOf<L>, N>(value_of(p), lattice).template value<T>(0), p);
}

template <class L, int N, class Lattice> MS_INLINE UInt32<L> cell_hash(const Vec<N, L>& p, const Lattice& lattice) {
  UInt32<L> hash = UInt32<L>(0u);
#pragma clang loop unroll(full)
  for (int i = 0; i < N; ++i)
    hash ^= lattice.at(floor(value_of(p[i])), i, 0);
  return hash;
}

/// A number that is a vector of one component.
template <class L> MS_INLINE Vec<1, L> as_vector(const L& x) { return {{x}}; }
template <class L, int N> MS_INLINE const Vec<N, L>& as_vector(const Vec<N, L>& v) { return v; }
template <class P> inline constexpr int dimensions_of = 1;
template <class L, int N> inline constexpr int dimensions_of<Vec<N, L>> = N;

/// The lattice with a period given as the point is.
template <class L, class P> MS_INLINE auto periodic(const P& period) {
  return Periodic<dimensions_of<P>, ValueOf<L>>(value_of(as_vector(period)));
}

// The rows of the table; P is L or Vec<N, L> --------------------------------------------------------------------------

template <class L, class P> MS_INLINE L valuenoise(const P& p) { return value_noise(as_vector(p), Endless()); }
template <class L, class P> MS_INLINE L pvaluenoise(const P& p, const P& period) {
  return value_noise(as_vector(p), periodic<L>(period));
}
template <class L, class P> MS_INLINE Vec<3, L> vvaluenoise(const P& given) {
  constexpr int N = dimensions_of<P>;
  using T = typename Interpolated<L, N>::Type;
  const Vec<N, L>& p = as_vector(given);
  const ValueCell<ValueOf<L>, N> cell(value_of(p), Endless());
  return {{noise_value(cell.template value<T>(0), p), noise_value(cell.template value<T>(1), p),
           noise_value(cell.template value<T>(2), p)}};
}

template <class L, class P> MS_INLINE L cellnoise(const P& p) {
  return unit_number<L>(mix_bits(cell_hash(as_vector(p), Endless())));
}
template <class L, class P> MS_INLINE L pcellnoise(const P& p, const P& period) {
  return unit_number<L>(mix_bits(cell_hash(as_vector(p), periodic<L>(period))));
}
template <class L, class P> MS_INLINE Vec<3, L> vcellnoise(const P& p) {
  UInt32<L> hash = mix_bits(cell_hash(as_vector(p), Endless()));
  return {{unit_number<L>(hash), unit_number<L>(mix_bits(hash + 0x9e3779b9u)),
           unit_number<L>(mix_bits(hash + 0x3c6ef372u))}};
}

} // namespace moonshade::stdlib
