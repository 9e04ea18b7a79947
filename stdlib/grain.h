// Solid patterns drawn by noise: wood and marble, 0..1, their mean 1/2. Like those of pattern.h they take the width of
// the pixel's footprint, in the units of p. How the footprint lies in space a width does not tell: they give an
// estimate of what squares of that width see that are turned all ways, on the average. Such squares see a wave of t
// waves a width with the contrast exp(-1.1 t^2 - 0.15 t^4), the mean over directions of sin(x)/x of the distances in a
// square, whose variance along one direction is width^2 / 18. Of what is finer than the square a little less is left,
// so that little is wrong where it lies across the waves.
//
// Noise is known at the point with its gradient and its Laplacian. From them follow the best estimate of what the
// footprint sees of the noise, how fast that changes, and how much else the noise varies within the footprint: what is
// sharpened by a fold or a ring must be blurred by it. Constants are by samples of the noise.
//
// Twice continuously differentiable but for wood's rings and the folds of marble's turbulence; not periodic. NaN and
// infinity give NaN.
//
// Sources: K. Perlin, "An image synthesizer" (1985), for marble; rings about an axis after D. Peachey, "Solid texturing
// of complex surfaces" (1985).
#pragma once

#include "stdlib/geometry.h"
#include "stdlib/noise.h"
#include "stdlib/periodic.h"

namespace moonshade::stdlib {

/// Noise less its mean times exp(-z/2), z being kNoiseFade times the square of the width, is the best estimate by its
/// value of what a footprint sees. From 1/32 on it is 0, so that noise which no lane sees need not be made.
inline constexpr double kNoiseFade = 3.24, kNoiseVariance = 0.1551, kMeanFold = 0.3142; ///< the last of |noise|
template <class L> MS_INLINE L fade_of(L square) { return exp(square * constant<L>(-0.5 * kNoiseFade)); }
template <class L> MS_INLINE L noise_seen(L fade) {
  L zero = constant<L>(0), one = constant<L>(1);
  return max(nmadd(one - fade, 32.0 / 31, one), zero);
}

/// Nothing to filter on any lane. Never of dual numbers: their derivatives would round in another way than beside lanes
/// that filter.
template <class L> MS_INLINE bool all_are_points(L width) {
  return !is_dual<L> && !any(!less_equal(width, constant<L>(0)));
}

/// Noise with its gradient and its Laplacian, of the lane type, so that they have derivatives where the lanes do.
template <class L> struct NoiseWithCurvature {
  L value;
  Vec<3, L> gradient;
  L laplacian;
};
/// The Laplacian of t^4 ramp(d) with t = 1/2 - d^2 is t^2 (24 - 88 t) ramp(d).
template <class L> struct SumWithCurvature : SumWithGradient<L, 3> {
  L bends = constant<L>(0);
  MS_INLINE void add(L t, const Vec<3, L>& d, const Ramp<L, 3>& ramp) {
    SumWithGradient<L, 3>::add(t, d, ramp);
    bends = madd(t * t * madd(t, -88.0, constant<L>(24)), ramp.at(d), bends);
  }
};
template <class L> MS_INLINE NoiseWithCurvature<L> noise_with_curvature(const Vec<3, L>& p) {
  SumWithCurvature<L> sum;
  add_noise<L>(p, sum);
  return {sum.value * constant<L>(kNoiseScale<3>), sum.gradient(kNoiseScale<3>),
          sum.bends * constant<L>(kNoiseScale<3>)};
}

/// The mean of |n| for n scattered about the mean m >= 0 (normally distributed), less m, and its slope by m. A fit of
/// 2 s (phi(h) - h (1 - Phi(h))), s the deviation and h = m / s, within 0.007 s: s / (1 + 0.157 h + 0.06 h^2)^8 times
/// what makes it true at 0.
template <class L> struct Folded {
  L more, slope;
};
template <class L> MS_INLINE Folded<L> folded(L m, L variance) {
  L deviation = sqrt(variance), scaled = m * deviation;
  L inverse = constant<L>(1) / (madd(m * m, 0.06, madd(scaled, 0.15667, variance)) + constant<L>(1e-30));
  L root = variance * inverse, square = root * root, fourth = square * square,
    more = fourth * fourth * constant<L>(0.7978845608028654);
  L fall = madd(scaled, 0.12 * 8, variance * constant<L>(0.15667 * 8)) * inverse;
  return {more * deviation, nmadd(more, fall, constant<L>(1))};
}

/// Perlin's turbulence of six octaves at a point.
template <class L> MS_INLINE L turbulence_at(const Vec<3, L>& p) {
  L mean = constant<L>(kMeanFold), one = constant<L>(1), sum = joined(constant<L>(0), p);
  Vec<3, L> q = p;
  double amplitude = 1;
#pragma clang loop unroll(disable)
  for (int octave = 0; octave < 6; ++octave, amplitude *= 0.5) {
    sum = madd(madd(abs(noise<L>(q)) - mean, one, mean), L(Scalar<L>(amplitude)), sum);
    q = q * constant<L>(2);
  }
  return sum;
}

/// The same as a footprint sees it; the value where it is a point has the same bits.
template <class L> struct SeenTurbulence {
  L value;
  Vec<3, L> slope; ///< of what is seen of it
  L hidden;        ///< the variance of what is not
};
template <class L> MS_INLINE SeenTurbulence<L> seen_turbulence(const Vec<3, L>& p, L width) {
  const L zero = constant<L>(0), one = constant<L>(1), mean = constant<L>(kMeanFold);
  const Vec<3, L> flat = {{zero, zero, zero}};
  Vec<3, L> q = p;
  // The square of the width in the octave's units.
  L square = width * width, fade = fade_of(square);
  SeenTurbulence<L> sum = {joined(zero, p, width), joined(flat, p, width), joined(zero, p, width)};
  double amplitude = 1;
#pragma clang loop unroll(disable)
  for (int octave = 0; octave < 6; ++octave, amplitude *= 0.5) {
    L scale = L(Scalar<L>(amplitude)), seen = noise_seen(fade), nothing = joined(zero, p);
    NoiseWithCurvature<L> n = {nothing, joined(flat, p), nothing};
    auto visible = less(zero, seen);
    if (any(visible)) {
      const NoiseWithCurvature<L> made = noise_with_curvature(q);
      n = {select(visible, made.value, n.value), select<3, L>(visible, made.gradient, n.gradient),
           select(visible, made.laplacian, n.laplacian)};
    }
    // On the average the Laplacian is -18 kNoiseFade times the value; where it differs, so does what is seen.
    L m = madd(madd(n.value, 18 * kNoiseFade, n.laplacian), square * constant<L>(1.0 / 36), n.value) * seen;
    // Within the footprint noise varies along its gradient, by its curvature, and in ways that are not known.
    L z = square * constant<L>(kNoiseFade), energy = seen * seen, bend = square * n.laplacian;
    L along = square * constant<L>(1.0 / 18) * energy * dot(n.gradient, n.gradient);
    L rest = nmadd(energy, madd(z, madd(z, 0.267, one), one), one) * constant<L>(kNoiseVariance);
    L variance = max(along + madd(bend * bend * energy, 3e-4, rest), zero);
    Folded<L> fold = folded(abs(m), variance);
    sum.value = madd(madd(abs(m) - mean, one, mean) + fold.more, scale, sum.value);
    // An octave's slope is as great as another's: amplitude and frequency cancel.
    L side = flip_sign(fold.slope * seen, bit_cast<Bits<L>>(plain(m)) & sign_bit<L>());
    sum.slope = madd(n.gradient, side, sum.slope);
    L hidden = variance - fold.more * madd(abs(m), 2.0, fold.more) - along * fold.slope * fold.slope;
    sum.hidden = madd(max(hidden, zero), scale * scale, sum.hidden);
    q = q * constant<L>(2);
    square = square * constant<L>(4);
    fade = (fade * fade) * (fade * fade);
  }
  return sum;
}

/// Veins along x, one in each unit, pushed about by `distortion` times Perlin's turbulence of six octaves.
template <class L> MS_INLINE L marble(Vec<3, L> p, L width, L distortion) {
  constexpr double kScale = 0.93; // not 1, so that noise and veins do not keep step
  constexpr double kTurn = 6.283185307179586;
  width = min(abs(width), constant<L>(4096)); // all there is to see is the mean
  L half = constant<L>(0.5), scale = constant<L>(kScale);
  const Vec<3, L> q = p * scale;
  if (all_are_points(width))
    return joined(madd(sin(madd(distortion, turbulence_at(q), p[0]) * constant<L>(kTurn)), 0.5, half), width);
  SeenTurbulence<L> seen = seen_turbulence(q, width * scale);
  // The veins' place as a plane through the point, and what scatters about it. Times the width first, so that where it
  // is 0 nothing overflows.
  L steep = distortion * scale;
  Vec<3, L> rise = seen.slope * width * steep;
  rise[0] = rise[0] + width;
  L waves = dot(rise, rise);
  L hidden = seen.hidden * distortion * distortion * constant<L>(0.5 * kTurn * kTurn);
  L contrast = exp(-madd(waves, madd(waves, 0.35, constant<L>(1.0966)), hidden));
  L wave = sin((madd(distortion, seen.value, p[0]) + nothing_of(p)) * constant<L>(kTurn));
  return madd(wave * contrast, 0.5, half);
}

/// Where in its year a ring is darkest.
inline constexpr double kDarkest = 0.85;

/// The integral from 0 to t of one ring in each unit: from 0 slowly to 1, and back over the last part.
template <class L> MS_INLINE L ring_integral(L t) {
  L whole = floor(t), rest = t - whole, fallen = max(rest - constant<L>(kDarkest), constant<L>(0));
  L rise = min(rest, constant<L>(kDarkest));
  return madd(whole, 0.5, madd(rise * rise, 0.5 / kDarkest, nmadd(fallen * fallen, 0.5 / (1 - kDarkest), fallen)));
}
/// One year's ring: from light at 0 slowly to dark, and back over the last part.
template <class L> MS_INLINE L ring(L t) {
  return min(t * constant<L>(1 / kDarkest), (constant<L>(1) - t) * constant<L>(1 / (1 - kDarkest)));
}
/// Seen through squares turned all ways, as wide as `width` rings: along a line they are boxes, as wide as twice the
/// distances from the middle in a square; two, that have the second and the fourth moment of all.
template <class L> MS_INLINE L ring(L t, L width) {
  constexpr double kNarrow = 0.002, kBox[2] = {0.495005, 1.043218}; // their squares 2/3 -+ sqrt(8/45)
  L reach = max(width, constant<L>(kNarrow)) * constant<L>(0.5), seen = constant<L>(0);
#pragma clang loop unroll(full)
  for (const double box : kBox) {
    L side = reach * constant<L>(box);
    seen = madd(ring_integral(t + side) - ring_integral(t - side), 0.25 / box, seen);
  }
  L mean = constant<L>(0.5);
  seen = mix(seen / reach, mean, smoothstep(constant<L>(0.5), constant<L>(2), width));
  return select(less(width, constant<L>(kNarrow)), ring(t), seen);
}

/// The noise that draws wood's fibres.
template <class L> MS_INLINE L fibres(const Vec<3, L>& p) {
  return noise<L>(Vec<3, L>{{p[0] * constant<L>(14), p[1] * constant<L>(0.7), p[2] * constant<L>(14)}});
}

/// Rings about the y axis, one in each unit, pushed about by `wobble`; `grain` is the share of fine fibres along it.
template <class L> MS_INLINE L wood(Vec<3, L> p, L width, L wobble, L grain) {
  constexpr double kAcross = 0.45, kAlong = 0.12;
  constexpr double kLowSquare = 0.111, kFibreSquare = 117; // of the width, in the units of either noise: by samples
  L half = constant<L>(0.5), zero = constant<L>(0), one = constant<L>(1), across = constant<L>(kAcross);
  width = min(abs(width), constant<L>(4096)); // all there is to see is the mean
  const Vec<3, L> q = {{p[0] * across, p[1] * constant<L>(kAlong), p[2] * across}};
  if (all_are_points(width)) {
    L radius = madd(wobble, noise<L>(q), length(Vec<2, L>{{p[0], p[2]}}));
    return joined(mix(ring(fract(radius)), madd(fibres(p), 0.5, half), grain), width);
  }
  L square = width * width, z = square * constant<L>(kLowSquare * kNoiseFade), seen = exp(z * constant<L>(-0.5));
  SumWithGradient<L, 3> low;
  add_noise<L>(q, low);
  Vec<3, L> slope = low.gradient(kNoiseScale<3>);
  // About the axis a footprint sees a radius that is not 0.
  L moved = wobble * seen;
  L away = sqrt(madd(square, 1.0 / 18, madd(p[2], p[2], p[0] * p[0])));
  L radius = madd(moved, low.value * constant<L>(kNoiseScale<3>), away);
  // How much the radius changes over the width in each direction, by its bend about the axis, and what scatters.
  L inverse = one / max(away, constant<L>(1e-6)), push = moved * across;
  slope = slope * width;
  L x = madd(p[0] * inverse, width, slope[0] * push), y = slope[1] * moved * constant<L>(kAlong);
  L change = madd(x, x, y * y);
  x = madd(p[2] * inverse, width, slope[2] * push);
  change = madd(x, x, change);
  L bend = square * inverse, hidden = max(nmadd(seen * seen, one + z, one), zero) * constant<L>(18 * kNoiseVariance);
  change = madd(bend * bend, 0.43 / 18, madd(hidden * wobble, wobble, change));
  L rings = ring(fract(radius), sqrt(change));
  L sharp = noise_seen(fade_of(square * constant<L>(kFibreSquare))), fibre = joined(zero, p);
  auto visible = less(zero, sharp);
  if (any(visible)) fibre = select(visible, fibres(p), fibre);
  return mix(rings, madd(fibre * sharp, 0.5, half), grain);
}

} // namespace moonshade::stdlib
