// Functions of numbers: the elementary ones by precision (math_f32.h, or C's own for doubles), Lua's floating
// operators, and the shapers of shading languages. The vectors' forms follow by component.
#pragma once

#include "stdlib/externals.h"
#include "stdlib/lane.h"
#include "stdlib/math_f32.h"

namespace moonshade::stdlib {

// Elementary functions: floats by our kernels, doubles by C's
// -----------------------------------------------------------

#define ONE(name)                                                                                                      \
  template <class L> MS_INLINE L name(L x) {                                                                           \
    if constexpr (is_f32<L>) {                                                                                         \
      return f32::name(x);                                                                                             \
    } else if constexpr (width_of<L> == 1) {                                                                           \
      return moonshade_##name(x);                                                                                      \
    } else {                                                                                                           \
      L result;                                                                                                        \
      moonshade_##name##_lanes(reinterpret_cast<double*>(&result), reinterpret_cast<const double*>(&x), width_of<L>);  \
      return result;                                                                                                   \
    }                                                                                                                  \
  }
#define TWO(name)                                                                                                      \
  template <class L> MS_INLINE L name(L x, NonDeduced<L> y) {                                                          \
    if constexpr (is_f32<L>) {                                                                                         \
      return f32::name(x, y);                                                                                          \
    } else if constexpr (width_of<L> == 1) {                                                                           \
      return moonshade_##name(x, y);                                                                                   \
    } else {                                                                                                           \
      L result;                                                                                                        \
      moonshade_##name##_lanes(reinterpret_cast<double*>(&result), reinterpret_cast<const double*>(&x),                \
                               reinterpret_cast<const double*>(&y), width_of<L>);                                      \
      return result;                                                                                                   \
    }                                                                                                                  \
  }
MS_EXTERNALS(ONE, TWO)
#undef ONE
#undef TWO

template <class L> MS_INLINE L inversesqrt(L x) { return constant<L>(1) / sqrt(x); }
template <class L> MS_INLINE L radians(L degrees) { return degrees * constant<L>(0x1.1df46a2529d39p-6); } // pi / 180
template <class L> MS_INLINE L degrees(L radians) { return radians * constant<L>(0x1.ca5dc1a63c1f8p+5); } // 180 / pi

// Lua's operators on numbers (lvm.c)
// ------------------------------------------------------------------------------------

template <class L> MS_INLINE L mod(L a, L b) {
  L m = fmod(a, b), zero = constant<L>(0);
  auto other_sign = (less(zero, m) & less(b, zero)) | (less(m, zero) & !less_equal(b, zero));
  return select(other_sign, m + b, m);
}
template <class L> MS_INLINE L floor_divide(L a, L b) { return floor(a / b); }
template <class L> MS_INLINE L power(L a, L b) { return select(equal(b, constant<L>(2)), a * a, pow(a, b)); }

// Rounding and ranges
// ---------------------------------------------------------------------------------------------------

template <class L> MS_INLINE L sign(L x) {
  L one = constant<L>(1), zero = constant<L>(0);
  return select(less(zero, x), one, select(less(x, zero), -one, x));
}

/// Less than 1 also where x - floor(x) rounds up to it.
template <class L> MS_INLINE L fract(L x) {
  L rest = x - floor(x), below_one = constant<L>(is_f32<L> ? 0x1.fffffep-1 : 0x1.fffffffffffffp-1);
  return select(less(below_one, rest), below_one, rest);
}

/// Halves away from zero: adding the number next below 1/2 never carries x over an integer that it does not reach.
template <class L> MS_INLINE L round(L x) {
  L almost_half = constant<L>(is_f32<L> ? 0x1.fffffep-2 : 0x1.fffffffffffffp-2);
  return trunc(x + copy_sign(almost_half, x));
}

template <class L> MS_INLINE L clamp(L x, L low, L high) { return min(max(x, low), high); }
template <class L> MS_INLINE L saturate(L x) { return clamp(x, constant<L>(0), constant<L>(1)); }

// Shapers
// ---------------------------------------------------------------------------------------------------------------

/// a - a*t + b*t: exactly a at 0 and b at 1.
template <class L> MS_INLINE L mix(L a, L b, L t) { return madd(b, t, nmadd(a, t, a)); }

template <class L> MS_INLINE L step(L edge, L x) {
  return select(less(x, edge), constant<L>(0), select(is_nan(x), x, constant<L>(1)));
}

/// 0 at a, 1 at b, and clamped; a step where a = b.
template <class L> MS_INLINE L linearstep(L a, L b, L x) {
  L t = saturate((x - a) / (b - a));
  return select(equal(a, b), step(a, x), t);
}
template <class L> MS_INLINE L smoothstep(L a, L b, L x) {
  L t = linearstep(a, b, x);
  return t * t * madd(t, -2.0, constant<L>(3));
}
/// Perlin's 6 t^5 - 15 t^4 + 10 t^3.
template <class L> MS_INLINE L fade(L t) { return t * t * t * madd(t, madd(t, 6.0, -15.0), 10.0); }
template <class L> MS_INLINE L smootherstep(L a, L b, L x) { return fade(linearstep(a, b, x)); }

template <class L> MS_INLINE L pulse(L a, L b, L x) { return step(a, x) - step(b, x); }

/// A step through a box filter; the sign of the width does not count, width 0 is the step itself.
template <class L> MS_INLINE L aastep(L edge, L x, L width) {
  L half = abs(width) * constant<L>(0.5);
  return linearstep(edge - half, edge + half, x);
}

/// Schlick's forms of Perlin's bias and gain (Graphics Gems IV, 1994).
template <class L> MS_INLINE L bias(L x, L b) {
  L one = constant<L>(1);
  return x / madd(one / b - constant<L>(2), one - x, one);
}
template <class L> MS_INLINE L gain(L x, L g) {
  L one = constant<L>(1);
  L steep = (one / g - constant<L>(2)) * nmadd(x, 2.0, one);
  return select(less(x, constant<L>(0.5)), x / (steep + one), (steep - x) / (steep - one));
}

} // namespace moonshade::stdlib
