// Colour. RGB is linear Rec. 709 unless a name says otherwise; nothing is clamped unless said. NaN and infinity go
// through the functions as through arithmetic.
//
// Sources: IEC 61966-2-1 (sRGB); A. R. Smith, "Color gamut transform pairs" (1978, HSV); B. Ottosson, "A perceptual
// color space for image processing" (2020, Oklab); M. Krystek, "An algorithm to calculate correlated colour
// temperature" (1985, the Planckian locus); ITU-R BT.709-6 (primaries, luminance); I. Quilez, "Palettes" (2015).
#pragma once

#include "stdlib/dual.h"
#include "stdlib/numbers.h"
#include "stdlib/vec.h"

namespace moonshade::stdlib {

/// a*x + b*y + c*z for constants.
template <class L> MS_INLINE L weighted(const Vec<3, L>& v, double a, double b, double c) {
  return madd(v[2], c, madd(v[1], b, v[0] * constant<L>(a)));
}

template <class L> MS_INLINE L luminance(Vec<3, L> rgb) { return weighted(rgb, 0.2126, 0.7152, 0.0722); }

/// factor (scale (x + offset))^exponent + rest. Floats go through doubles, so that neither the exponent nor what stands
/// about the power rounds before the end.
struct PowerCurve {
  double offset, scale, exponent, factor, rest;
};
template <class L> MS_INLINE L power_curve(L x, const PowerCurve& c) {
  if constexpr (is_dual<L>) {
    const PowerCurve slope = {c.offset, c.scale, c.exponent - 1, c.factor * c.scale * c.exponent, 0};
    return chain<L>(power_curve(x.v, c), x, power_curve(x.v, slope));
  } else if constexpr (is_f32<L>) {
    using D = Wide<double, width_of<L>>;
    D power = f32::power_of_double((convert<D>(x) + constant<D>(c.offset)) * constant<D>(c.scale), c.exponent);
    return convert<L>(fused(power, c.factor, c.rest));
  } else {
    return madd(pow((x + constant<L>(c.offset)) * constant<L>(c.scale), constant<L>(c.exponent)), c.factor, c.rest);
  }
}

/// Both lines go on below 0 and above 1.
template <class L> MS_INLINE L srgb2linear(L x) {
  L curve = power_curve(x, {0.055, 1 / 1.055, 2.4, 1, 0});
  return select(less(constant<L>(0.04045), x), curve, x * constant<L>(1 / 12.92));
}
template <class L> MS_INLINE L linear2srgb(L x) {
  L curve = power_curve(x, {0, 1, 1 / 2.4, 1.055, -0.055});
  return select(less(constant<L>(0.0031308), x), curve, x * constant<L>(12.92));
}

/// Hue in turns, of period 1: red 0, green 1/3, blue 2/3.
template <class L> MS_INLINE Vec<3, L> hsv2rgb(Vec<3, L> hsv) {
  L chroma = hsv[1] * hsv[2];
  auto channel = [&](double turn) __attribute__((always_inline)) {
    L k = fract(hsv[0] + constant<L>(turn)) * constant<L>(6);
    L down = saturate(min(k, constant<L>(4) - k));
    return nmadd(chroma, down, hsv[2]);
  };
  return {{channel(5.0 / 6), channel(0.5), channel(1.0 / 6)}};
}

/// Of grey the hue is 0, of black the saturation too.
template <class L> MS_INLINE Vec<3, L> rgb2hsv(Vec<3, L> rgb) {
  L r = rgb[0], g = rgb[1], b = rgb[2], zero = constant<L>(0);
  L value = max(max(r, g), b), chroma = value - min(min(r, g), b);
  L sixths = select(equal(value, r), (g - b) / chroma,
                    select(equal(value, g), (b - r) / chroma + constant<L>(2), (r - g) / chroma + constant<L>(4)));
  L hue = fract(sixths * constant<L>(1.0 / 6));
  auto grey = equal(chroma, zero);
  return {{select(grey, zero, hue), select(equal(value, zero), zero, chroma / value), value}};
}

/// The cube root, also of negative numbers.
template <class L> MS_INLINE L cube_root(L x) { return copy_sign(pow(abs(x), constant<L>(1.0 / 3)), x); }

template <class L> MS_INLINE Vec<3, L> rgb2oklab(Vec<3, L> rgb) {
  Vec<3, L> lms = {{cube_root(weighted(rgb, 0.4122214708, 0.5363325363, 0.0514459929)),
                    cube_root(weighted(rgb, 0.2119034982, 0.6806995451, 0.1073969566)),
                    cube_root(weighted(rgb, 0.0883024619, 0.2817188376, 0.6299787005))}};
  return {{weighted(lms, 0.2104542553, 0.7936177850, -0.0040720468),
           weighted(lms, 1.9779984951, -2.4285922050, 0.4505937099),
           weighted(lms, 0.0259040371, 0.7827717662, -0.8086757660)}};
}
template <class L> MS_INLINE Vec<3, L> oklab2rgb(Vec<3, L> lab) {
  auto cube = [](L x) __attribute__((always_inline)) { return x * x * x; };
  Vec<3, L> lms = {{cube(weighted(lab, 1, 0.3963377774, 0.2158037573)),
                    cube(weighted(lab, 1, -0.1055613458, -0.0638541728)),
                    cube(weighted(lab, 1, -0.0894841775, -1.2914855480))}};
  return {{weighted(lms, 4.0767416621, -3.3077115913, 0.2309699292),
           weighted(lms, -1.2684380046, 2.6097574011, -0.3413193965),
           weighted(lms, -0.0041960863, -0.7034186147, 1.7076147010)}};
}

/// The colour of a glowing black body, its greatest component 1, components outside Rec. 709 cut to 0. Kelvins are
/// clamped to 1000..40000.
template <class L> MS_INLINE Vec<3, L> blackbody(L kelvins) {
  L t = clamp(kelvins, constant<L>(1000), constant<L>(40000)), zero = constant<L>(0), one = constant<L>(1);
  L u =
      madd(madd(t, 1.28641212e-7, 1.54118254e-4), t, 0.860117757) / madd(madd(t, 7.08145163e-7, 8.42420235e-4), t, one);
  L v = madd(madd(t, 4.20481691e-8, 4.22806245e-5), t, 0.317398726) /
        madd(madd(t, 1.61456053e-7, -2.89741816e-5), t, one);
  // X, Y and Z over Y, from CIE 1960 u and v: X = 3u / 2v, Z = (4 - u - 10v) / 2v.
  L half = constant<L>(0.5) / v;
  Vec<3, L> xyz = {{u * constant<L>(3) * half, one, (constant<L>(4) - u - v * constant<L>(10)) * half}};
  L r = max(weighted(xyz, 3.2404542, -1.5371385, -0.4985314), zero);
  L g = max(weighted(xyz, -0.9692660, 1.8760108, 0.0415560), zero);
  L b = max(weighted(xyz, 0.0556434, -0.2040259, 1.0572252), zero);
  L scale = one / max(max(r, g), b);
  return {{r * scale, g * scale, b * scale}};
}

/// a + b cos(2 pi (c t + d)): period 1 where c is integral.
template <class L> MS_INLINE Vec<3, L> palette(L t, Vec<3, L> a, Vec<3, L> b, Vec<3, L> c, Vec<3, L> d) {
  return map<3, L>([t](L a, L b, L c, L d) __attribute__((
                       always_inline)) { return madd(b, cos(madd(c, t, d) * constant<L>(6.283185307179586)), a); },
                   a, b, c, d);
}

} // namespace moonshade::stdlib
