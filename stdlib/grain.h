// Solid patterns drawn by noise: wood and marble, 0..1, their mean 1/2. Like those of pattern.h they take the width of
// the pixel's footprint, in the units of p, and give an estimate of what a square of that width sees, turned any way:
// noise that is finer than it gives way to its mean, and rings and veins lose the contrast that they lose at the speed
// at which they change there, which the noise's exact gradient tells. Twice continuously differentiable but for wood's
// rings and the folds of marble's turbulence; not periodic. NaN and infinity give NaN.
//
// Sources: K. Perlin, "An image synthesizer" (1985), for marble; rings about an axis after D. Peachey, "Solid texturing
// of complex surfaces" (1985).
#pragma once

#include "stdlib/geometry.h"
#include "stdlib/noise.h"
#include "stdlib/periodic.h"

namespace moonshade::stdlib {

/// How much a square of a width sees of noise: noise less its mean, times this, is the best estimate of what the square
/// sees, exp(-k w^2) by samples. For a square twice as wide it is the fourth power.
inline constexpr double kSmoothSeen = 1.62, kFoldedSeen = 3.7; ///< k of noise and of |noise|
template <class L> MS_INLINE L noise_seen(L width, double k) { return exp(width * width * constant<L>(-k)); }

/// Noise with its gradient, both of the lane type, so that the gradient has derivatives where the lanes do.
template <class L> struct NoiseWithGradient {
  L value;
  Vec<3, L> gradient;
};
template <class L> MS_INLINE NoiseWithGradient<L> noise_with_gradient(const Vec<3, L>& p) {
  SumWithGradient<L, 3> sum;
  add_noise<L>(p, sum);
  return {sum.value * constant<L>(kNoiseScale<3>), sum.gradient(kNoiseScale<3>)};
}

/// Perlin's turbulence of six octaves as a footprint sees it.
template <class L> struct SeenTurbulence {
  L value;
  Vec<3, L> slope; ///< of what is seen of it
  L hidden;        ///< the variance of what is not
};
/// Without `sloped`, slope and hidden stay 0; the value has the same bits.
template <bool sloped, class L> MS_INLINE SeenTurbulence<L> seen_turbulence(const Vec<3, L>& p, L width) {
  constexpr double kMean = 0.3142, kVariance = 0.0555; // of |noise|, measured
  L zero = constant<L>(0), one = constant<L>(1), mean = constant<L>(kMean), seen = noise_seen(width, kFoldedSeen);
  Vec<3, L> q = joined(p, width);
  SeenTurbulence<L> sum = {joined(zero, p, width), joined(Vec<3, L>{{zero, zero, zero}}, p, width),
                           joined(zero, width)};
  double amplitude = 1;
#pragma clang loop unroll(disable)
  for (int octave = 0; octave < 6; ++octave, amplitude *= 0.5) {
    L scale = L(Scalar<L>(amplitude)), value;
    if constexpr (sloped) {
      NoiseWithGradient<L> n = noise_with_gradient(q);
      value = n.value;
      // An octave's slope is as great as another's: amplitude and frequency cancel.
      L side = flip_sign(seen, bit_cast<Bits<L>>(plain(value)) & sign_bit<L>()), unseen = one - seen;
      sum.slope = madd(n.gradient, side, sum.slope);
      sum.hidden = madd(unseen * unseen, scale * scale * constant<L>(kVariance), sum.hidden);
    } else {
      value = noise<L>(q);
    }
    sum.value = madd(madd(abs(value) - mean, seen, mean), scale, sum.value);
    q = q * constant<L>(2);
    seen = (seen * seen) * (seen * seen);
  }
  return sum;
}

/// sin(pi x) / (pi x): what a box of width x leaves of a wave of length 1.
template <class L> MS_INLINE L box_contrast(L x) {
  L angle = madd(abs(x), 3.141592653589793, constant<L>(1e-9));
  return sin(angle) / angle;
}

/// Veins along x, one in each unit, pushed about by `distortion` times Perlin's turbulence of six octaves.
template <class L> MS_INLINE L marble(Vec<3, L> p, L width, L distortion) {
  constexpr double kScale = 0.93; // not 1, so that noise and veins do not keep step
  constexpr double kTurn = 6.283185307179586;
  // Between the extent of a square along its sides (1) and that of one turned any way, on the average (0.82).
  constexpr double kExtent = 0.9;
  width = min(abs(width), constant<L>(4096));
  L half = constant<L>(0.5), one = constant<L>(1), scale = constant<L>(kScale);
  const Vec<3, L> q = p * scale;
  const bool points = !any(!less_equal(width, constant<L>(0))); // nothing to filter on any lane
  const bool sloped = is_dual<L> || !points;
  SeenTurbulence<L> seen =
      sloped ? seen_turbulence<true, L>(q, width * scale) : seen_turbulence<false, L>(q, width * scale);
  // The veins' place as a plane through the point, and what scatters about it.
  L contrast = exp(seen.hidden * distortion * distortion * constant<L>(-0.5 * kTurn * kTurn)),
    box = width * constant<L>(kExtent);
  L steep = distortion * scale;
  contrast = contrast * box_contrast(madd(seen.slope[0], steep, one) * box);
  contrast = contrast * box_contrast(seen.slope[1] * steep * box) * box_contrast(seen.slope[2] * steep * box);
  contrast = contrast * (one - smoothstep(constant<L>(2), constant<L>(3.5), width));
  L wave = sin(madd(distortion, seen.value, p[0]) * constant<L>(kTurn));
  return madd(wave * contrast, 0.5, half);
}

/// The integral from 0 to t of one ring in each unit: from 0 slowly to 1, and back over the last part.
template <class L> MS_INLINE L ring_integral(L t) {
  constexpr double kDark = 0.85;
  L whole = floor(t), rest = t - whole, fallen = max(rest - constant<L>(kDark), constant<L>(0));
  L rise = min(rest, constant<L>(kDark));
  return madd(whole, 0.5, madd(rise * rise, 0.5 / kDark, nmadd(fallen * fallen, 0.5 / (1 - kDark), fallen)));
}
/// One year's ring: from light at 0 slowly to dark, and back over the last part; seen through a box.
template <class L> MS_INLINE L ring(L t, L width) {
  constexpr double kDark = 0.85, kNarrow = 0.002;
  L itself = min(t * constant<L>(1 / kDark), (constant<L>(1) - t) * constant<L>(1 / (1 - kDark)));
  L reach = max(width, constant<L>(kNarrow)) * constant<L>(0.5);
  L seen = (ring_integral(t + reach) - ring_integral(t - reach)) / (reach + reach);
  return select(less(width, constant<L>(kNarrow)), itself, seen);
}

/// Rings about the y axis, one in each unit, pushed about by `wobble`; `grain` is the share of fine fibres along it.
template <class L> MS_INLINE L wood(Vec<3, L> p, L width, L wobble, L grain) {
  constexpr double kAcross = 0.45, kAlong = 0.12;
  constexpr double kExtent = 0.9;             // as in marble
  width = min(abs(width), constant<L>(4096)); // all there is to see is the mean
  NoiseWithGradient<L> low = noise_with_gradient(
      Vec<3, L>{{p[0] * constant<L>(kAcross), p[1] * constant<L>(kAlong), p[2] * constant<L>(kAcross)}});
  L seen = noise_seen(width * constant<L>(kAcross), kSmoothSeen), moved = wobble * seen;
  L away = length(Vec<2, L>{{p[0], p[2]}}), radius = madd(moved, low.value, away);
  // How fast the radius changes in each direction; the square as a box along it.
  L inverse = constant<L>(1) / max(away, constant<L>(1e-6));
  L across = moved * constant<L>(kAcross), x = madd(p[0], inverse, low.gradient[0] * across);
  L z = madd(p[2], inverse, low.gradient[2] * across), y = moved * low.gradient[1] * constant<L>(kAlong);
  L slope = sqrt(madd(x, x, madd(y, y, z * z))) * constant<L>(kExtent);
  L rings = ring(fract(radius), slope * width);
  L fibre = noise<L>(Vec<3, L>{{p[0] * constant<L>(14), p[1] * constant<L>(0.7), p[2] * constant<L>(14)}});
  L fine = madd(fibre * noise_seen(width * constant<L>(14), kSmoothSeen), 0.5, constant<L>(0.5));
  return mix(rings, fine, grain);
}

} // namespace moonshade::stdlib
