// Solid patterns drawn by noise: wood and marble, 0..1, their mean 1/2. Like those of pattern.h they take the width of
// the pixel's footprint, in the units of p: noise that is finer than it gives way to its mean, and rings and veins lose
// contrast as a box of that width takes it from them. Twice continuously differentiable but for wood's rings and the
// folds of marble's turbulence; not periodic. NaN and infinity give NaN.
//
// Sources: K. Perlin, "An image synthesizer" (1985), for marble; rings about an axis after D. Peachey, "Solid texturing
// of complex surfaces" (1985).
#pragma once

#include "stdlib/geometry.h"
#include "stdlib/noise.h"
#include "stdlib/periodic.h"

namespace moonshade::stdlib {

/// 1 for noise of wavelength 1 that is far wider than the footprint, 0 where it is finer.
template <class L> MS_INLINE L noise_visible(L width) {
  return constant<L>(1) - smoothstep(constant<L>(0.25), constant<L>(0.9), width);
}

/// Veins along x, one in each unit, pushed about by `distortion` times Perlin's turbulence of six octaves.
template <class L> MS_INLINE L marble(Vec<3, L> p, L width, L distortion) {
  // Not 1, so that noise and veins do not keep step.
  constexpr double kScale = 0.93;
  // Of |noise|, measured over 10^6 points: mean, variance, mean square of the slope along an axis.
  constexpr double kMean = 0.3142, kVariance = 0.0558, kSlope = 3.08 * kScale * kScale;
  constexpr double kTurn = 6.283185307179586;
  width = min(abs(width), constant<L>(4096)); // all there is to see is the mean
  L half = constant<L>(0.5), mean = constant<L>(kMean), square = width * width;
  Vec<3, L> q = joined(p * constant<L>(kScale), width);
  L sum = joined(constant<L>(0), p, width), filter = width * constant<L>(kScale);
  // The variance of the veins' place within the box: of the slopes seen, and of the noise that gave way.
  L variance = joined(constant<L>(0), width);
  double amplitude = 1;
#pragma clang loop unroll(disable)
  for (int octave = 0; octave < 6; ++octave, amplitude *= 0.5) {
    L seen = noise_visible(filter), folded = abs(noise<L>(q));
    L scale = L(Scalar<L>(amplitude));
    sum = madd(madd(folded - mean, seen, mean), scale, sum);
    variance = variance + mix(scale * scale * constant<L>(kVariance), square * constant<L>(kSlope / 6), seen * seen);
    q = q * constant<L>(2);
    filter = filter * constant<L>(2);
  }
  variance = madd(variance * distortion, distortion, square * constant<L>(1.0 / 12));
  L contrast = exp(variance * constant<L>(-0.5 * kTurn * kTurn));
  L wave = sin(madd(distortion, sum, p[0]) * constant<L>(kTurn));
  return madd(wave * contrast, 0.5, half);
}

/// One year's ring: from light at 0 slowly to dark, and back over the last part; seen through a box.
template <class L> MS_INLINE L ring(L t, L width) {
  constexpr double kDark = 0.85;
  L rise = constant<L>(kDark), fall = constant<L>(1 - kDark), one = constant<L>(1);
  L value = filtered_step(t - constant<L>(kDark / 2), rise, width) -
            filtered_step(t - constant<L>((1 + kDark) / 2), fall, width) + one -
            filtered_step(t + constant<L>((1 - kDark) / 2), fall, width) +
            filtered_step(t - constant<L>(1 + kDark / 2), rise, width);
  return mix(value, constant<L>(0.5), smoothstep(constant<L>(0.4), constant<L>(1.2), width));
}

/// Rings about the y axis, one in each unit, pushed about by `wobble`; `grain` is the share of fine fibres along it.
template <class L> MS_INLINE L wood(Vec<3, L> p, L width, L wobble, L grain) {
  width = abs(width);
  L low = noise<L>(Vec<3, L>{{p[0] * constant<L>(0.45), p[1] * constant<L>(0.12), p[2] * constant<L>(0.45)}});
  L radius = madd(wobble, low, length(Vec<2, L>{{p[0], p[2]}}));
  L rings = ring(fract(radius), width);
  L fibre = noise<L>(Vec<3, L>{{p[0] * constant<L>(14), p[1] * constant<L>(0.7), p[2] * constant<L>(14)}});
  L fine = madd(fibre * noise_visible(width * constant<L>(14)), 0.5, constant<L>(0.5));
  return mix(rings, fine, grain);
}

} // namespace moonshade::stdlib
