// Dual numbers: lanes that carry a value and its derivatives in N directions, so that the one body of each function of
// the library also gives derivatives (forward mode; values by the very operations of plain lanes, hence the same bits).
//
// Which derivatives are zero is known without looking at lanes: a dual number carries a bit for each direction,
// `active`, that is never computed from data. After inlining it is a constant, and what would multiply by a zero is
// gone; strict floating point could not drop it (x*0 is not 0). A loop must begin with what it will have: see `joined`.
//
// Conventions. A branch (select, abs, min, max) has the derivative of the side taken. floor, ceil, trunc, hashes and
// the integer lattice are constant. Where a slope is infinite or does not exist (sqrt at 0, so length at 0; asin and
// acos at +-1; atan2 at the origin; x^y by y at x = 0 and for negative x), the derivative is 0. Division by zero and
// logarithms of zero have the infinite or NaN slopes of their formulas.
#pragma once

#include "stdlib/hash.h"
#include "stdlib/numbers.h"
#include "stdlib/vec.h"

namespace moonshade::stdlib {

template <class L, int N> struct Dual {
  using Lane = L;
  static constexpr int directions = N;

  L v;
  L d[N];
  unsigned active;

  MS_INLINE constexpr Dual() : v(L(Scalar<L>(0))), active(0) { clear(std::make_index_sequence<N>()); }
  /// A constant.
  MS_INLINE constexpr explicit Dual(Scalar<L> value) : v(L(value)), active(0) { clear(std::make_index_sequence<N>()); }
  MS_INLINE static constexpr Dual of(L value) {
    Dual result;
    result.v = value;
    return result;
  }
  /// Not trivial, for the reason of Vec's.
  MS_INLINE constexpr ~Dual() {}
  MS_INLINE constexpr Dual(const Dual&) = default;
  MS_INLINE constexpr Dual& operator=(const Dual&) = default;

  MS_INLINE constexpr bool on(int k) const { return (active >> k & 1) != 0; }

private:
  template <size_t... K> MS_INLINE constexpr void clear(std::index_sequence<K...>) { ((d[K] = L(Scalar<L>(0))), ...); }
};

/// Everything that depends on the lane type but its number is that of plain lanes.
template <class L, int N> struct LaneTraits<Dual<L, N>> {
  using Scalar = typename LaneTraits<L>::Scalar;
  static constexpr int width = LaneTraits<L>::width;
};

template <class T> inline constexpr bool is_dual = false;
template <class L, int N> inline constexpr bool is_dual<Dual<L, N>> = true;
template <class T>
concept DualLane = is_dual<T>;
template <class T>
concept PlainLane = !is_dual<T>;

/// The number without derivatives of any order.
template <PlainLane L> MS_INLINE L plain(L x) { return x; }
template <DualLane D> MS_INLINE auto plain(const D& x) { return plain(x.v); }

// Combinations --------------------------------------------------------------------------------------------------------

/// `value`, with derivative f(k) in each direction of `active`.
template <DualLane D, class F> MS_INLINE D with_tangents(typename D::Lane value, unsigned active, F f) {
  D result = D::of(value);
  result.active = active;
  [&]<size_t... K>(std::index_sequence<K...>) __attribute__((always_inline)) {
    ((result.on(K) ? void(result.d[K] = f(int(K))) : void()), ...);
  }(std::make_index_sequence<D::directions>());
  return result;
}

/// g * a' ; g * a' + h * b'
template <DualLane D> MS_INLINE D chain(typename D::Lane value, const D& a, typename D::Lane g) {
  return with_tangents<D>(value, a.active, [&](int k) __attribute__((always_inline)) { return a.d[k] * g; });
}
template <DualLane D>
MS_INLINE D chain(typename D::Lane value, const D& a, typename D::Lane g, const D& b, typename D::Lane h) {
  return with_tangents<D>(value, a.active | b.active, [&](int k) __attribute__((always_inline)) {
    if (!a.on(k)) return b.d[k] * h;
    return b.on(k) ? madd(b.d[k], h, a.d[k] * g) : a.d[k] * g;
  });
}
template <DualLane D>
MS_INLINE D chain(typename D::Lane value, const D& a, typename D::Lane g, const D& b, typename D::Lane h, const D& c,
                  typename D::Lane i) {
  D both = chain<D>(value, a, g, b, h);
  return with_tangents<D>(value, both.active | c.active, [&](int k) __attribute__((always_inline)) {
    if (!c.on(k)) return both.d[k];
    return both.on(k) ? madd(c.d[k], i, both.d[k]) : c.d[k] * i;
  });
}

/// In a loop, a number that begins with fewer directions than it will have would not have a constant `active`.
template <PlainLane L, class... A> MS_INLINE L joined(L x, const A&...) { return x; }
template <DualLane D> MS_INLINE unsigned active_of(const D& x) { return x.active; }
template <int N, DualLane D> MS_INLINE unsigned active_of(const Vec<N, D>& v) {
  return [&]<size_t... I>(std::index_sequence<I...>)
             __attribute__((always_inline)) { return (v[I].active | ...); }(std::make_index_sequence<N>());
}
/// Of the derivatives' own derivatives.
template <DualLane D> MS_INLINE unsigned inner_active_of(const D& x) {
  return [&]<size_t... K>(std::index_sequence<K...>) __attribute__((always_inline)) {
    return x.v.active | ((x.on(K) ? x.d[K].active : 0u) | ...);
  }(std::make_index_sequence<D::directions>());
}
template <int N, DualLane D> MS_INLINE unsigned inner_active_of(const Vec<N, D>& v) {
  return [&]<size_t... I>(std::index_sequence<I...>)
             __attribute__((always_inline)) { return (inner_active_of(v[I]) | ...); }(std::make_index_sequence<N>());
}
/// x, with the directions of others too, where its derivatives are 0.
template <DualLane D, class... A> MS_INLINE D joined(D x, const A&... others) {
  x.active |= (active_of(others) | ...);
  if constexpr (is_dual<typename D::Lane>) {
    const unsigned inner = inner_active_of(x) | (inner_active_of(others) | ...);
    x.v.active |= inner;
    [&]<size_t... K>(std::index_sequence<K...>) __attribute__((always_inline)) {
      ((x.on(K) ? void(x.d[K].active |= inner) : void()), ...);
    }(std::make_index_sequence<D::directions>());
  }
  return x;
}
template <int N, class L, class... A> MS_INLINE Vec<N, L> joined(const Vec<N, L>& v, const A&... others) {
  return map<N, L>([&](L x) __attribute__((always_inline)) { return joined(x, others...); }, v);
}

// Arithmetic ----------------------------------------------------------------------------------------------------------

template <DualLane D> MS_INLINE D operator-(const D& a) {
  return with_tangents<D>(-a.v, a.active, [&](int k) __attribute__((always_inline)) { return -a.d[k]; });
}
template <DualLane D> MS_INLINE D operator+(const D& a, const D& b) {
  return with_tangents<D>(a.v + b.v, a.active | b.active, [&](int k) __attribute__((always_inline)) {
    if (!a.on(k)) return b.d[k];
    return b.on(k) ? a.d[k] + b.d[k] : a.d[k];
  });
}
template <DualLane D> MS_INLINE D operator-(const D& a, const D& b) {
  return with_tangents<D>(a.v - b.v, a.active | b.active, [&](int k) __attribute__((always_inline)) {
    if (!a.on(k)) return -b.d[k];
    return b.on(k) ? a.d[k] - b.d[k] : a.d[k];
  });
}
template <DualLane D> MS_INLINE D operator*(const D& a, const D& b) { return chain<D>(a.v * b.v, a, b.v, b, a.v); }
template <DualLane D> MS_INLINE D operator/(const D& a, const D& b) {
  using L = typename D::Lane;
  L quotient = a.v / b.v, inverse = constant<L>(1) / b.v;
  return chain<D>(quotient, a, inverse, b, -(quotient * inverse));
}

template <DualLane D, class B, class C> MS_INLINE D madd(D a, B given_b, C given_c) {
  using L = typename D::Lane;
  D b = operand<D>(given_b), c = operand<D>(given_c);
  L value = madd(a.v, b.v, c.v);
  return with_tangents<D>(value, a.active | b.active | c.active, [&](int k) __attribute__((always_inline)) {
    L sum = c.d[k];
    bool any = c.on(k);
    if (b.on(k)) {
      sum = any ? madd(b.d[k], a.v, sum) : b.d[k] * a.v;
      any = true;
    }
    if (a.on(k)) sum = any ? madd(a.d[k], b.v, sum) : a.d[k] * b.v;
    return sum;
  });
}

template <DualLane D> MS_INLINE Mask<D> less(D a, D b) { return less(a.v, b.v); }
template <DualLane D> MS_INLINE Mask<D> less_equal(D a, D b) { return less_equal(a.v, b.v); }
template <DualLane D> MS_INLINE Mask<D> equal(D a, D b) { return equal(a.v, b.v); }
template <DualLane D> MS_INLINE Mask<D> is_nan(D a) { return is_nan(a.v); }
template <DualLane D> MS_INLINE Mask<D> sign_is_set(D a) { return sign_is_set(a.v); }

template <class I, int W, DualLane D> MS_INLINE D select(LaneMask<I, W> mask, D a, D b) {
  return with_tangents<D>(select(mask, a.v, b.v), a.active | b.active,
                          [&](int k) __attribute__((always_inline)) { return select(mask, a.d[k], b.d[k]); });
}

/// The derivative times +-1.
template <DualLane D> MS_INLINE D flip_sign(D x, Bits<D> sign) {
  return with_tangents<D>(flip_sign(x.v, sign), x.active,
                          [&](int k) __attribute__((always_inline)) { return flip_sign(x.d[k], sign); });
}
template <DualLane D> MS_INLINE D abs(D x) { return flip_sign(x, bit_cast<Bits<D>>(plain(x)) & sign_bit<D>()); }
template <DualLane D> MS_INLINE D copy_sign(D magnitude, D sign) {
  return flip_sign(magnitude, (bit_cast<Bits<D>>(plain(magnitude)) ^ bit_cast<Bits<D>>(plain(sign))) & sign_bit<D>());
}

template <DualLane D> MS_INLINE D floor(D x) { return D::of(floor(x.v)); }
template <DualLane D> MS_INLINE D ceil(D x) { return D::of(ceil(x.v)); }
template <DualLane D> MS_INLINE D trunc(D x) { return D::of(trunc(x.v)); }

template <class To, DualLane From>
  requires PlainLane<To>
MS_INLINE To convert(From value) {
  return convert<To>(value.v);
}
template <DualLane To, PlainLane From> MS_INLINE To convert(From value) {
  return To::of(convert<typename To::Lane>(value));
}
template <DualLane D> MS_INLINE UInt32<D> hash_bits(D x) { return hash_bits(x.v); }
template <DualLane D> MS_INLINE UInt32<D> mixed_bits(D x) { return mixed_bits(x.v); }
template <DualLane D> MS_INLINE UInt32<D> lattice(D i) { return lattice(i.v); }

/// The lane of the value alone, and a lane without derivatives made of one.
template <class L> struct ValueLaneOf {
  using type = L;
};
template <class L, int N> struct ValueLaneOf<Dual<L, N>> {
  using type = L;
};
template <class L> using ValueLane = typename ValueLaneOf<L>::type;
template <class L> MS_INLINE L without_slope(ValueLane<L> value) {
  if constexpr (is_dual<L>)
    return L::of(value);
  else
    return value;
}
template <class L> MS_INLINE ValueLane<L> value_lane(const L& x) {
  if constexpr (is_dual<L>)
    return x.v;
  else
    return x;
}
template <DualLane D, int N> MS_INLINE D hash(Vec<N, D> v) {
  using L = typename D::Lane;
  return D::of(hash(map<N, L>([](const D& x) __attribute__((always_inline)) { return x.v; }, v)));
}

// Elementary functions ------------------------------------------------------------------------------------------------

/// g where it is finite, else 0: for slopes that become infinite.
template <class L> MS_INLINE L finite_slope(L g) {
  return select(less(abs(g), infinity<L>()), g, select(is_nan(g), g, constant<L>(0)));
}

template <DualLane D> MS_INLINE D sqrt(D x) {
  using L = typename D::Lane;
  L root = sqrt(x.v);
  return chain<D>(root, x, finite_slope(constant<L>(0.5) / root));
}

/// Sine and cosine of one angle, which is reduced once.
template <class L> struct SineCosine {
  L sine, cosine;
};
template <class L> MS_INLINE SineCosine<L> sine_cosine(L x) {
  if constexpr (is_dual<L>) {
    auto both = sine_cosine(x.v);
    return {chain<L>(both.sine, x, both.cosine), chain<L>(both.cosine, x, -both.sine)};
  } else if constexpr (is_f32<L>) {
    auto angle = f32::reduce(x);
    return {f32::sine(angle, 0), f32::sine(angle, 1)};
  } else {
    return {sin(x), cos(x)};
  }
}
template <DualLane D> MS_INLINE D sin(D x) {
  auto both = sine_cosine(x.v);
  return chain<D>(both.sine, x, both.cosine);
}
template <DualLane D> MS_INLINE D cos(D x) {
  auto both = sine_cosine(x.v);
  return chain<D>(both.cosine, x, -both.sine);
}
template <DualLane D> MS_INLINE D tan(D x) {
  using L = typename D::Lane;
  L value = tan(x.v);
  return chain<D>(value, x, madd(value, value, constant<L>(1)));
}
template <class L> MS_INLINE L asin_slope(L x) {
  return finite_slope(constant<L>(1) / sqrt((constant<L>(1) - x) * (constant<L>(1) + x)));
}
template <DualLane D> MS_INLINE D asin(D x) { return chain<D>(asin(x.v), x, asin_slope(x.v)); }
template <DualLane D> MS_INLINE D acos(D x) { return chain<D>(acos(x.v), x, -asin_slope(x.v)); }
template <DualLane D> MS_INLINE D atan(D x) {
  using L = typename D::Lane;
  return chain<D>(atan(x.v), x, constant<L>(1) / madd(x.v, x.v, constant<L>(1)));
}
template <DualLane D> MS_INLINE D atan2(D y, NonDeduced<D> x) {
  using L = typename D::Lane;
  L square = madd(x.v, x.v, y.v * y.v), zero = constant<L>(0), inverse = constant<L>(1) / square;
  auto flat = equal(square, zero) | equal(square, infinity<L>());
  return chain<D>(atan2(y.v, x.v), y, select(flat, zero, x.v * inverse), x, select(flat, zero, -(y.v * inverse)));
}
template <DualLane D> MS_INLINE D exp(D x) {
  auto value = exp(x.v);
  return chain<D>(value, x, value);
}
template <DualLane D> MS_INLINE D log(D x) {
  using L = typename D::Lane;
  return chain<D>(log(x.v), x, constant<L>(1) / x.v);
}
template <DualLane D> MS_INLINE D log_to_base(D x, NonDeduced<D> base) {
  using L = typename D::Lane;
  L value = log_to_base(x.v, base.v), inverse = constant<L>(1) / log(base.v);
  return chain<D>(value, x, inverse / x.v, base, -(value * inverse / base.v));
}

/// y x^(y-1), as x^y y/x; at x = 0: 0 for y = 0 and y > 1, 1 for y = 1, else infinite, so 0. A power of a negative
/// number exists for integral y alone: no slope by y.
template <DualLane D> MS_INLINE D pow(D x, NonDeduced<D> y) {
  using L = typename D::Lane;
  L zero = constant<L>(0), one = constant<L>(1), value = pow(x.v, y.v);
  L by_x = select(equal(x.v, zero), select(equal(y.v, one), one, zero), value / x.v * y.v);
  L by_y = select(equal(x.v, zero) | (less(x.v, zero) & !is_nan(value)), zero, value * log(x.v));
  return chain<D>(value, x, by_x, y, by_y);
}

// The shapers' slopes with the common factor b or g out, so that they hold at 0 too, where the values' formulas go
// through infinity.
template <DualLane D> MS_INLINE D bias(D x, D b) {
  using L = typename D::Lane;
  L one = constant<L>(1), rest = one - x.v;
  L under = madd(nmadd(b.v, 2.0, one), rest, b.v), inverse = one / (under * under);
  return chain<D>(bias(x.v, b.v), x, b.v * (one - b.v) * inverse, b, x.v * rest * inverse);
}
template <DualLane D> MS_INLINE D gain(D x, D g) {
  using L = typename D::Lane;
  L one = constant<L>(1), side = nmadd(x.v, 2.0, one), steep = nmadd(g.v, 2.0, one) * side;
  auto low = less(x.v, constant<L>(0.5));
  L under = select(low, steep + g.v, steep - g.v), inverse = one / (under * under);
  return chain<D>(gain(x.v, g.v), x, g.v * (one - g.v) * inverse, g, select(low, x.v, one - x.v) * side * inverse);
}

/// x - y trunc(x/y)
template <DualLane D> MS_INLINE D fmod(D x, NonDeduced<D> y) {
  using L = typename D::Lane;
  return chain<D>(fmod(x.v, y.v), x, constant<L>(1), y, -trunc(x.v / y.v));
}

} // namespace moonshade::stdlib
