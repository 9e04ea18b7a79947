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
/// clamped to 1000..40000. Floats go through doubles, where terms cancel.
template <class L> MS_INLINE Vec<3, L> blackbody(L kelvins) {
  if constexpr (!is_dual<L> && is_f32<L>) {
    return map<3, L>([](auto x) __attribute__((always_inline)) { return convert<L>(x); },
                     blackbody(convert<Wide<double, width_of<L>>>(kelvins)));
  } else {
    L t = clamp(kelvins, constant<L>(1000), constant<L>(40000)), zero = constant<L>(0);
    auto polynomial = [t](double a, double b, double c, double d, double e) __attribute__((always_inline)) {
      return madd(madd(madd(madd(t, a, constant<L>(b)), t, c), t, d), t, e);
    };
    // The CIE 1960 u and v of a black body are quotients of quadratics in t, X = 3u / 2v and Z = (4 - u - 10v) / 2v:
    // times all denominators each component is a polynomial.
    L r = polynomial(4.117263431e-14, 1.108104339e-10, 1.580847751e-6, 2.90045368e-4, 7.402747413);
    L g = polynomial(5.709448707e-14, 1.748828101e-10, 3.737207301e-7, 7.873475895e-4, -1.311579086);
    L b = polynomial(1.380653646e-13, -2.481204667e-10, 1.926719419e-8, -7.524269148e-5, -0.02199217568);
    L scale = constant<L>(1) / max(max(r, g), b);
    Vec<3, L> color = {{r * scale, max(g, zero) * scale, max(b, zero) * scale}};
    if constexpr (is_dual<L>) { // the very value of plain lanes
      Vec<3, typename L::Lane> value = blackbody(kelvins.v);
      for (int i = 0; i < 3; ++i)
        color[i].v = value[i];
    }
    return color;
  }
}

/// a + b cos(2 pi (c t + d)): period 1 where c is integral.
template <class L> MS_INLINE Vec<3, L> palette(L t, Vec<3, L> a, Vec<3, L> b, Vec<3, L> c, Vec<3, L> d) {
  return map<3, L>([t](L a, L b, L c, L d) __attribute__((
                       always_inline)) { return madd(b, cos(madd(c, t, d) * constant<L>(6.283185307179586)), a); },
                   a, b, c, d);
}

} // namespace moonshade::stdlib
