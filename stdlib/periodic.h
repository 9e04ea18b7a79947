// What the patterns are made of: steps and periodic pulses seen through a box filter of the footprint's width, exactly.
//
// A step of ramp r filtered by a box of width w is a box of width r convolved with one of width w, integrated: linear
// in the middle, quadratic at both ends. A pulse is two steps. Where the box reaches beyond the neighbouring pulses,
// the filtered pulse is the difference of the pulses' integral at the box's ends, which loses no precision there.
#pragma once

#include "stdlib/dual.h"
#include "stdlib/numbers.h"
#include "stdlib/vec.h"

namespace moonshade::stdlib {

/// 0 far below c = 0, 1 far above: a step at 0, ramped over `ramp`, through a box of `width`; both at least 0. The step
/// itself, 1 from 0 on, where both are 0.
template <class L> MS_INLINE L filtered_step(L c, L ramp, L width) {
  L half = constant<L>(0.5), distance = abs(c), longer = max(ramp, width), shorter = min(ramp, width);
  L outer = (longer + shorter) * half, inner = (longer - shorter) * half, rest = outer - distance;
  L curve = nmadd(rest * rest, half / (longer * shorter), half);
  L line = distance / longer;
  L rise = select(less_equal(outer, distance), half, select(less(inner, distance), curve, line));
  return select(less(c, constant<L>(0)), half - rise, half + rise);
}

/// The same with its slopes: the derivatives by c, by the longer and by the shorter of ramp and width.
template <DualLane D> MS_INLINE D filtered_step(D c, D ramp, D width) {
  using L = typename D::Lane;
  L half = constant<L>(0.5), zero = constant<L>(0), one = constant<L>(1);
  L distance = abs(c.v), longer = max(ramp.v, width.v), shorter = min(ramp.v, width.v);
  L outer = (longer + shorter) * half, inner = (longer - shorter) * half, rest = outer - distance;
  auto is_flat = less_equal(outer, distance), is_curve = less(inner, distance);
  L steepness = rest / (longer * shorter), line = one / longer;
  L by_c = select(is_flat, zero, select(is_curve, steepness, line));
  // Of the rise above the middle, which lies on the side of c.
  auto of_length = [&](L length) __attribute__((always_inline)) {
    L on_curve = steepness * half * (rest / length - one);
    L turned = select(less(c.v, zero), -on_curve, on_curve);
    return select(is_flat, zero, select(is_curve, turned, zero));
  };
  L by_longer = select(is_flat | is_curve, of_length(longer), -(c.v * line * line)), by_shorter = of_length(shorter);
  auto ramp_is_longer = less_equal(width.v, ramp.v);
  return chain<D>(filtered_step(c.v, ramp.v, width.v), c, by_c, ramp, select(ramp_is_longer, by_longer, by_shorter),
                  width, select(ramp_is_longer, by_shorter, by_longer));
}

/// The integral from 0 to t of pulses at all integers: 2 `half` wide at half height, ramps of `ramp`.
template <class L> MS_INLINE L pulse_integral(L t, L half, L ramp) {
  L nearest = floor(t + constant<L>(0.5)), rest = t - nearest, distance = abs(rest), zero = constant<L>(0);
  L flat = nmadd(ramp, 0.5, half), on_ramp = clamp(distance - flat, zero, ramp);
  L fallen = on_ramp * on_ramp * (constant<L>(0.5) / max(ramp, constant<L>(1e-30)));
  L own = min(distance, flat) + on_ramp - fallen;
  return madd(nearest * half, 2.0, select(less(rest, zero), -own, own));
}

/// Pulses of width `duty` (0..1) and height 1 in the middle of each unit, their flanks ramped inwards over `ramp`,
/// through a box of `width`. The mean, duty - ramp, where the box is wide.
template <class L> MS_INLINE L filtered_pulse(L x, L duty, L ramp, L width) {
  L zero = constant<L>(0), one = constant<L>(1), middle = constant<L>(0.5);
  duty = saturate(duty);
  ramp = clamp(ramp, zero, duty * middle);
  width = min(abs(width), constant<L>(4096)); // a whole number of periods: the mean
  L half = (duty - ramp) * middle;
  L s = fract(x) - middle;
  auto left = less(s, zero);
  L own = filtered_step(s + half, ramp, width) - filtered_step(s - half, ramp, width);
  L gap = one - half, next = filtered_step(select(left, s + gap, s - gap), ramp, width);
  L near = own + select(left, one - next, next);
  auto wide = !less(width + ramp, one);
  L far = joined(zero, x, half, ramp, width);
  if (any(wide)) {
    L reach = width * middle;
    L more = joined(pulse_integral(s + reach, half, ramp), far), less = pulse_integral(s - reach, half, ramp);
    far = (more - less) / width;
  }
  return select(wide, far, near);
}

/// The same pulse's value and its slopes by the four arguments. A function of its own in the bitcode, as each pattern
/// has several pulses, which would all be copied for each direction.
template <class L> [[gnu::noinline]] static void pulse_with_slopes(const L* arguments, L* results) {
  using D = Dual<L, 4>;
  auto seed = [&](int i) __attribute__((always_inline)) {
    D x = D::of(arguments[i]);
    x.active = 1u << i;
    x.d[i] = constant<L>(1);
    return x;
  };
  const D pulse = filtered_pulse<D>(seed(0), seed(1), seed(2), seed(3));
  results[0] = pulse.v;
#pragma clang loop unroll(full)
  for (int i = 0; i < 4; ++i)
    results[1 + i] = pulse.d[i];
}

/// filtered_pulse, for patterns: dual numbers take the slopes from the one function.
template <class L> MS_INLINE L pulse_of(L x, L duty, L ramp, L width) {
  if constexpr (is_dual<L>) {
    using V = ValueLane<L>;
    const V arguments[4] = {x.v, duty.v, ramp.v, width.v};
    V results[5];
    pulse_with_slopes(arguments, results);
    const L inner = chain<L>(results[0], x, results[1], duty, results[2]);
    const L outer = chain<L>(results[0], ramp, results[3], width, results[4]);
    return with_tangents<L>(results[0], inner.active | outer.active, [&](int k) __attribute__((always_inline)) {
      if (!inner.on(k)) return outer.d[k];
      return outer.on(k) ? inner.d[k] + outer.d[k] : inner.d[k];
    });
  } else {
    return filtered_pulse(x, duty, ramp, width);
  }
}

/// 0, or NaN where a coordinate is NaN or infinity: for what the point no longer shows in.
template <class L, int N> MS_INLINE L nothing_of(const Vec<N, L>& p) {
  ValueLane<L> nothing = value_lane(p[0]) - value_lane(p[0]);
#pragma clang loop unroll(full)
  for (int i = 1; i < N; ++i)
    nothing = nothing + (value_lane(p[i]) - value_lane(p[i]));
  return without_slope<L>(nothing);
}

} // namespace moonshade::stdlib
