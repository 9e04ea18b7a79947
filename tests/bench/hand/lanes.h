// What the hand-written workloads are built from: N numbers side by side (clang's vectors; a plain float for N = 1),
// and the few operations that vectors have no operator for. Each N is compiled in one file alone, with the flags of the
// machine it is for, so that no two versions of a function meet in the linker.
#pragma once

#include <cstdint>
#include <cstring>

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace hand {

#define HAND [[gnu::always_inline]] inline

template <int N> struct Lanes {
  using F = float __attribute__((ext_vector_type(N)));
  using I = int32_t __attribute__((ext_vector_type(N)));
  using U = uint32_t __attribute__((ext_vector_type(N)));
};
template <> struct Lanes<1> {
  using F = float;
  using I = int32_t;
  using U = uint32_t;
};
template <int N> using F = typename Lanes<N>::F;
template <int N> using I = typename Lanes<N>::I;
template <int N> using U = typename Lanes<N>::U;

template <class To, class From> HAND To bits(From from) { return __builtin_bit_cast(To, from); }
template <class C, class V> HAND V choose(C condition, V a, V b) { return condition ? a : b; }

/// A truth value a lane, in the form that the machine's masks have.
template <int N> using Mask = bool __attribute__((ext_vector_type(N)));
template <int N, class C> HAND Mask<N> mask(C comparison) { return __builtin_convertvector(comparison, Mask<N>); }
template <int N, class V> HAND V choose(Mask<N> condition, V a, V b) {
  return __builtin_convertvector(condition, I<N>) != 0 ? a : b;
}

template <int N> HAND F<N> to_float(I<N> i) {
  if constexpr (N == 1)
    return static_cast<float>(i);
  else
    return __builtin_convertvector(i, F<N>);
}
template <int N> HAND I<N> to_int(F<N> x) {
  if constexpr (N == 1)
    return static_cast<int32_t>(x);
  else
    return __builtin_convertvector(x, I<N>);
}
template <int N> HAND bool any(I<N> mask) {
  if constexpr (N == 1)
    return mask != 0;
  else
    return __builtin_reduce_or(mask) != 0;
}
template <class V> HAND V fused(V a, V b, V c) { return __builtin_elementwise_fma(a, b, c); }
template <class V> HAND V floor(V x) { return __builtin_elementwise_floor(x); }
template <class V> HAND V magnitude(V x) { return __builtin_elementwise_abs(x); }
template <class V> HAND V least(V a, V b) { return __builtin_elementwise_min(a, b); }
template <class V> HAND V greatest(V a, V b) { return __builtin_elementwise_max(a, b); }
template <class V> HAND V root(V x) { return __builtin_elementwise_sqrt(x); }

/// x with the sign bits of `sign` flipped.
template <int N> HAND F<N> flip(F<N> x, U<N> sign) { return bits<F<N>>(bits<U<N>>(x) ^ sign); }

template <int N> HAND F<N> load(const float* from) {
  F<N> value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
template <int N> HAND void store(float* to, F<N> value) { std::memcpy(to, &value, sizeof value); }

template <int N> struct Vec3 {
  F<N> x, y, z;
};
template <int N> HAND Vec3<N> operator+(Vec3<N> a, Vec3<N> b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <int N> HAND Vec3<N> operator*(Vec3<N> a, float s) { return {a.x * s, a.y * s, a.z * s}; }

struct Color {
  float r, g, b;
};
template <int N> HAND Vec3<N> mix(Color a, Color b, F<N> t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

/// Sine for |x| below some thousands: pi taken off in two parts, then an odd polynomial of degree 9 (error 1e-7).
template <int N> HAND F<N> sine(F<N> x) {
  const F<N> turns = __builtin_elementwise_roundeven(F<N>(x * 0.318309886f));
  const F<N> r = fused(turns, F<N>(-9.67653589793e-4f), fused(turns, F<N>(-3.140625f), x));
  const F<N> s = r * r;
  const F<N> p = r + r * s * (-0.166666597f + s * (8.33307139e-3f + s * (-1.98106118e-4f + s * 2.60831371e-6f)));
  return flip<N>(p, bits<U<N>>(to_int<N>(turns)) << 31);
}

} // namespace hand
