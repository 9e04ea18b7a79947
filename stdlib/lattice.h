// The integer lattice under noise, without end or periodic, and what is drawn at its points.
//
// A lattice policy gives the part of a lattice point's hash that one coordinate contributes: at(i, axis, step) for the
// coordinate i + step, i an integral number. The parts of all axes are combined by exclusive or, then mixed. So one
// body of each noise serves its endless form and its periodic one.
//
// A period is a whole number of cells for each axis, given as a number: fractions are dropped, and what is below 1
// (NaN too) counts as 1, what is above 2^22 as 2^22. All policies are exact for |i| < 2^22 in float, 2^50 in double.
#pragma once

#include "stdlib/dual.h"
#include "stdlib/hash.h"
#include "stdlib/numbers.h"
#include "stdlib/vec.h"

#include <utility>

namespace moonshade::stdlib {

struct Endless {
  template <class L> MS_INLINE UInt32<L> at(L i, int axis, int step) const {
    return lattice(i) * kLatticePrimes[axis] + UInt32<L>(uint32_t(step) * kLatticePrimes[axis]); // one product for all
  }
};

/// i modulo the period, both integral numbers.
template <class L> MS_INLINE L wrapped(L i, L period) { return i - period * floor(i / period); }

template <class L> MS_INLINE L whole_period(L period) {
  L whole = floor(abs(period)), most = constant<L>(0x1p22), one = constant<L>(1);
  return select(less_equal(one, whole), min(whole, most), one);
}

template <int N, class L> struct Periodic {
  Vec<N, L> period;

  MS_INLINE explicit Periodic(const Vec<N, L>& given)
      : period(map<N, L>([](L x) __attribute__((always_inline)) { return whole_period(x); }, given)) {}
  MS_INLINE UInt32<L> at(L i, int axis, int step) const {
    return lattice(wrapped(i + constant<L>(step), period[axis])) * kLatticePrimes[axis];
  }
};

/// Dual numbers' lattices are those of their values.
template <PlainLane L> MS_INLINE L value_of(const L& x) { return x; }
template <DualLane D> MS_INLINE typename D::Lane value_of(const D& x) { return x.v; }
template <class L> using ValueOf = decltype(value_of(std::declval<L>()));
template <int N, class L> MS_INLINE Vec<N, ValueOf<L>> value_of(const Vec<N, L>& v) {
  return map<N, ValueOf<L>>([](const L& x) __attribute__((always_inline)) { return value_of(x); }, v);
}
/// A number of L that has no derivative.
template <class L> MS_INLINE L constant_of(L x) { return x; }
template <DualLane D> MS_INLINE D constant_of(typename D::Lane x) { return D::of(x); }

/// The way from the point to a fixed one, of which the value is known: it moves against the point.
template <class L, int N> MS_INLINE Vec<N, L> way_from(const Vec<N, L>&, const Vec<N, L>& way) { return way; }
template <DualLane D, int N> MS_INLINE Vec<N, D> way_from(const Vec<N, D>& p, const Vec<N, typename D::Lane>& way) {
  return [&]<size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    return Vec<N, D>{
        {with_tangents<D>(way[I], p[I].active, [&](int k) __attribute__((always_inline)) { return -p[I].d[k]; })...}};
  }(std::make_index_sequence<N>());
}

/// The chain rule from the gradient at the point's value.
template <DualLane D, int N>
MS_INLINE D chain(typename D::Lane value, const Vec<N, D>& p, const Vec<N, typename D::Lane>& gradient) {
  using L = typename D::Lane;
  return with_tangents<D>(value, active_of(p), [&](int k) __attribute__((always_inline)) {
    L sum = constant<L>(0);
    bool any = false;
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i) {
      if (!p[i].on(k)) continue;
      sum = any ? madd(p[i].d[k], gradient[i], sum) : p[i].d[k] * gradient[i];
      any = true;
    }
    return sum;
  });
}

// Interpolation over the corners of a cell, of values alone or of values with their gradients by the place in it
// -------

/// The slope of `fade`.
template <class L> MS_INLINE L fade_slope(L t) {
  return constant<L>(30) * (t * t) * madd(t, t - constant<L>(2), constant<L>(1));
}

/// a at t = 0, b at t = 1, along the axis on which t has the slope dt.
template <class L> struct Flat {
  L value;
  template <int Axis> MS_INLINE static Flat mix(L t, L, const Flat& a, const Flat& b) {
    return {madd(t, b.value - a.value, a.value)};
  }
};
template <class L, int N> struct Sloped {
  L value;
  Vec<N, L> slope = {};
  template <int Axis> MS_INLINE static Sloped mix(L t, L dt, const Sloped& a, const Sloped& b) {
    L rise = b.value - a.value;
    Sloped result = {madd(t, rise, a.value), a.slope};
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i)
      result.slope[i] = madd(t, b.slope[i] - a.slope[i], a.slope[i]);
    result.slope[Axis] = madd(rise, dt, result.slope[Axis]);
    return result;
  }
};

/// The number of L that either stands for, at the point p.
template <class L, int N> MS_INLINE L noise_value(const Flat<L>& x, const Vec<N, L>&) { return x.value; }
template <DualLane D, int N> MS_INLINE D noise_value(const Sloped<typename D::Lane, N>& x, const Vec<N, D>& p) {
  return chain<D>(x.value, p, x.slope);
}
/// Which of them numbers of L need.
template <class L, int N> struct Interpolated {
  using Type = Flat<L>;
};
template <DualLane D, int N> struct Interpolated<D, N> {
  using Type = Sloped<typename D::Lane, N>;
};

/// Another hash of a lattice point from its first, for vectors of noise: the first one for 0.
template <class U> MS_INLINE U other_hash(U hash, int which) {
  if (which == 0) return hash;
  return (hash ^ (hash >> 15u)) * (which == 1 ? 0x2c1b3c6du : 0x297a2d39u);
}

} // namespace moonshade::stdlib
