// The transcendental functions on lanes of floats: within two units in the last place of the true value over all
// floats, the same bits at every width and on every machine. No tables, and no branches but one: arguments of sin, cos
// and tan beyond 2^17, reduced apart where any lane has one.
//
// Polynomials come from fit_polynomials.py, which prints their errors. Reductions subtract multiples of a constant
// split into floats of 24 bits (Cody and Waite), where a fused multiply-add makes each step but the last exact; great
// arguments are multiplied by the bits of 1/pi that count (Payne and Hanek). pow and log to a base work in doubles.
#pragma once

#include "stdlib/lane.h"

namespace moonshade::stdlib::f32 {

// All parts are positive, so that no multiple of 0 turns -0 into 0.
inline constexpr float kPi[2] = {0x1.921fb4p+1f, 0x1.4442d0p-23f};
inline constexpr float kHalfPi[3] = {0x1.921fb4p+0f, 0x1.4442d0p-24f, 0x1.846988p-48f};
inline constexpr float kLn2[2] = {0x1.62e430p-1f, -0x1.05c610p-29f};

/// Adding it rounds a float below 2^22 to an integer, which then stands in the lower bits; the same for doubles.
inline constexpr double kRound = 0x1.8p23;
inline constexpr double kRoundDouble = 0x1.8p52;

// Sine, cosine, tangent -----------------------------------------------------------------------------------------------

/// Beyond it an angle is reduced by huge_turns.
inline constexpr double kHugeAngle = 0x1p17;

/// |x| / pi modulo 2 as a binary fraction: bit 63 counts 1. For |x| >= 2^17; some value for others.
template <class F> [[gnu::noinline]] static void huge_turns(const F* x, UInt<F>* turns) {
  // The places of 1/pi in words of 32 bits; the first word lies before the point.
  static constexpr uint32_t inverse_pi[8] = {0,          0x517cc1b7, 0x27220a94, 0xfe13abe8,
                                             0xfa9a6ee0, 0x6db14acc, 0x9e21c820, 0xff28b1d5};
  using U32 = UInt32<F>;
  using U64 = UInt<F>;
  U32 bits = bit_cast<U32>(*x) & U32(0x7fffffffu);
  U32 mantissa = (bits & U32(0x007fffffu)) | U32(0x00800000u);
  // |x| = mantissa * 2^(exponent - 150): the bits of 1/pi that count begin at this place of the words.
  U32 place = (bits >> U32(23u)) - U32(119u);
  U32 first = place >> U32(5u);
  U64 offset = convert<U64>(place & U32(31u));
  U64 words[4];
#pragma clang loop unroll(full)
  for (uint32_t i = 0; i < 4; ++i) {
    U32 word = U32(inverse_pi[i]);
#pragma clang loop unroll(full)
    for (uint32_t k = 1; k < 5; ++k)
      word = select(to_mask<F>(first == U32(k)), U32(inverse_pi[k + i]), word);
    words[i] = convert<U64>(word);
  }
  U64 m = convert<U64>(mantissa), low32 = U64(uint64_t(0xffffffff)), half = U64(uint64_t(32));
  U64 window[3];
#pragma clang loop unroll(full)
  for (int i = 0; i < 3; ++i)
    window[i] = ((((words[i] << half) | words[i + 1]) << offset) >> half) & low32;
  *turns = ((m * window[0]) << half) + m * window[1] + ((m * window[2]) >> half);
}

/// An angle x = k pi/2 + rest + tail, |rest| at most pi/4 but for rounding; of k the lower two bits are good.
template <class F> struct Angle {
  F rest, tail;
  UInt32<F> k;
};

template <class F> MS_INLINE Angle<F> reduce_huge(F x) {
  using D = Wide<double, width_of<F>>;
  using U64 = UInt<F>;
  U64 turns;
  huge_turns(&x, &turns);
  U64 rounded = turns + U64(uint64_t(1) << 61);
  D fraction = convert<D>(bit_cast<Int<F>>(turns << U64(uint64_t(2)))) * D(0x1.921fb54442d18p+0 * 0x1p-64);
  fraction = select(less(x, constant<F>(0)), -fraction, fraction);
  F rest = convert<F>(fraction);
  UInt32<F> k = convert<UInt32<F>>(rounded >> U64(uint64_t(62)));
  return {select(less(abs(x), infinity<F>()), rest, not_a_number<F>()), convert<F>(fraction - convert<D>(rest)),
          select(less(x, constant<F>(0)), UInt32<F>(0u) - k, k)};
}

template <class F> MS_INLINE Angle<F> reduce(F x) {
  F shifted = fused(x, 0x1.45f306dc9c883p-1, kRound); // 2 / pi
  F k = shifted - constant<F>(kRound);
  F exact = fused(k, -kHalfPi[0], x);
  F rest = fused(k, -kHalfPi[2], fused(k, -kHalfPi[1], exact));
  // What rounding left of the rest, by Knuth's sum without error; only the tangent asks for it.
  F product = k * constant<F>(kHalfPi[1]), lost = fused(k, kHalfPi[1], -product);
  F sum = exact - product, back = sum - exact;
  F error = (exact - (sum - back)) - (product + back);
  F tail = (sum - rest) + fused(k, -kHalfPi[2], error - lost);
  Angle<F> angle = {rest, tail, bit_cast<UInt32<F>>(shifted)};
  auto huge = less(constant<F>(kHugeAngle), abs(x));
  if (any(huge)) {
    Angle<F> far = reduce_huge(x);
    angle.rest = select(huge, far.rest, angle.rest);
    angle.tail = select(huge, far.tail, angle.tail);
    angle.k = select(huge, far.k, angle.k);
  }
  return angle;
}

/// The sine of a reduced angle with k quarters added: by turns +-sin and +-cos of the rest.
template <class F> MS_INLINE F sine(Angle<F> angle, uint32_t quarters) {
  using U = UInt32<F>;
  U k = angle.k + U(quarters);
  F r = angle.rest, z = r * r;
  F odd = copy_sign(fused(r * z, fused_polynomial(z, {-0x1.555546p-3f, 0x1.110778p-7f, -0x1.995400p-13f}), r), r);
  F even = fused(z * z, fused_polynomial(z, {0x1.55554ap-5f, -0x1.6c0c22p-10f, 0x1.99e4d4p-16f}),
                 fused(z, -0.5, constant<F>(1)));
  F value = select(to_mask<F>((k & U(1u)) == U(0u)), odd, even);
  return flip_sign(value, (k << U(30u)) & U(0x80000000u));
}

template <class F> MS_INLINE F sin(F x) { return sine(reduce(x), 0); }
template <class F> MS_INLINE F cos(F x) { return sine(reduce(x), 1); }

/// tan(k pi/2 + r) = tan r for even k, -1 / tan r for odd.
template <class F> MS_INLINE F tan(F x) {
  using U = UInt32<F>;
  Angle<F> angle = reduce(x);
  F r = angle.rest, z = r * r;
  F p = fused_polynomial(z, {0x1.555560p-2f, 0x1.110da0p-3f, 0x1.bad946p-5f, 0x1.5cc668p-6f, 0x1.62ace4p-7f,
                             0x1.afad24p-14f, 0x1.1e6aa8p-8f});
  F rise = fused(r * z, p, fused(angle.tail, z, angle.tail)); // tan(r + tail) - r, the slope being near 1 + r^2
  F t = copy_sign(r + rise, r);
  F left = rise - (t - r);
  F inverse = constant<F>(-1) / t;
  inverse = fused(inverse, fused(inverse, t, fused(inverse, left, constant<F>(1))), inverse);
  return select(to_mask<F>((angle.k & U(1u)) == U(0u)), t, inverse);
}

// Inverse functions ---------------------------------------------------------------------------------------------------

/// asin of s in 0 .. 1/2, z = s*s
template <class F> MS_INLINE F asin_near_zero(F s, F z) {
  F p = fused_polynomial(z, {0x1.5555c8p-3f, 0x1.330206p-4f, 0x1.747b72p-5f, 0x1.8c415ap-6f, 0x1.5959aap-5f});
  return fused(s * z, p, s);
}

/// asin x = pi/2 - 2 asin sqrt((1 - x) / 2) for x > 1/2.
template <class F> MS_INLINE F asin(F x) {
  F a = abs(x);
  auto great = less(constant<F>(0.5), a);
  F z = select(great, fused(a, -0.5, 0.5), a * a);
  F p = asin_near_zero(select(great, sqrt(z), a), z);
  F complement = fused(p, -2.0, constant<F>(kHalfPi[0])) + constant<F>(kHalfPi[1]);
  return copy_sign(select(great, complement, p), x);
}

template <class F> MS_INLINE F acos(F x) {
  F a = abs(x);
  auto great = less(constant<F>(0.5), a);
  F z = select(great, fused(a, -0.5, 0.5), a * a);
  F p = asin_near_zero(select(great, sqrt(z), a), z);
  auto negative = sign_is_set(x);
  F near_one = select(negative, fused(p, -2.0, constant<F>(kPi[0])) + constant<F>(kPi[1]), p + p);
  F middle = (constant<F>(kHalfPi[0]) - copy_sign(p, x)) + constant<F>(kHalfPi[1]);
  return select(great, near_one, middle);
}

/// atan of t in -1 .. 1
template <class F> MS_INLINE F atan_near_zero(F t) {
  F z = t * t;
  F p = fused_polynomial(z, {-0x1.55553ep-2f, 0x1.9991eap-3f, -0x1.2420fap-3f, 0x1.c092dcp-4f, -0x1.5820e8p-4f,
                             0x1.da89d2p-5f, -0x1.fe56fap-6f, 0x1.6527a6p-7f, -0x1.d5546ap-10f});
  return fused(t * z, p, t);
}

/// atan x = pi/2 + atan(-1/x) for x > 1.
template <class F> MS_INLINE F atan(F x) {
  F a = abs(x);
  auto great = less(constant<F>(1), a);
  F p = atan_near_zero(select(great, constant<F>(-1) / a, a));
  return copy_sign(select(great, constant<F>(kHalfPi[0]) + (p + constant<F>(kHalfPi[1])), p), x);
}

/// The angle of the point (x, y), by C's rules for zeros and infinities.
template <class F> MS_INLINE F atan2(F y, F x) {
  F a = abs(y), b = abs(x);
  auto steep = less(b, a);
  F small = select(steep, b, a), great = select(steep, a, b);
  F q = small / great;
  q = select(equal(great, constant<F>(0)), constant<F>(0), q);
  q = select(equal(small, infinity<F>()), constant<F>(1), q);
  F p = atan_near_zero(q);
  p = select(steep, (constant<F>(kHalfPi[0]) - p) + constant<F>(kHalfPi[1]), p);
  p = select(sign_is_set(x), (constant<F>(kPi[0]) - p) + constant<F>(kPi[1]), p);
  p = copy_sign(p, y);
  return select(is_nan(x) | is_nan(y), x + y, p);
}

// Exponential and logarithm -------------------------------------------------------------------------------------------

/// e^x = 2^n e^r, the power of two in two factors so that results below 2^-126 are rounded once.
template <class F> MS_INLINE F exp(F x) {
  // Beyond the bounds the result is 0 or infinity; a NaN passes both comparisons.
  F clamped = select(less(x, constant<F>(-105)), constant<F>(-105), x);
  clamped = select(less(constant<F>(90), clamped), constant<F>(90), clamped);
  F shifted = fused(clamped, 0x1.715476p+0, constant<F>(kRound));
  F n = shifted - constant<F>(kRound);
  F r = fused(n, -kLn2[1], fused(n, -kLn2[0], clamped));
  F p = fused_polynomial(r, {0x1.fffffcp-2f, 0x1.555492p-3f, 0x1.5558aep-5f, 0x1.123980p-7f, 0x1.6a4f6cp-10f});
  F value = fused(r * r, p, r) + constant<F>(1);
  using I = Int32<F>;
  I exponent = bit_cast<I>(shifted) - I(0x4b400000);
  I half = exponent >> I(1);
  F first = bit_cast<F>((half + I(127)) << I(23)), second = bit_cast<F>((exponent - half + I(127)) << I(23));
  return value * first * second;
}

/// x = 2^e m with m in sqrt(1/2) .. sqrt(2), log x = e log 2 + log m.
template <class F> MS_INLINE F log(F x) {
  using U = UInt32<F>;
  using I = Int32<F>;
  auto tiny = less(x, constant<F>(0x1p-126));
  F scaled = select(tiny, x * constant<F>(0x1p23), x);
  U bits = bit_cast<U>(scaled);
  I exponent = bit_cast<I>(bits - U(0x3f3504f3u)) >> I(23);
  F f = bit_cast<F>(bits - (bit_cast<U>(exponent) << U(23u))) - constant<F>(1);
  F e = convert<F>(exponent) - select(tiny, constant<F>(23), constant<F>(0));
  F p = fused_polynomial(f, {0x1.555554p-2f, -0x1.000228p-2f, 0x1.99a022p-3f, -0x1.54721ap-3f, 0x1.22d860p-3f,
                             -0x1.0d852cp-3f, 0x1.056530p-3f, -0x1.38cb8ep-4f});
  F tail = fused(f * f, fused(f, p, -0.5), e * constant<F>(kLn2[1]));
  F value = fused(e, kLn2[0], f + tail);
  value = select(less(x, infinity<F>()), value, x); // infinity, NaN
  value = select(equal(x, constant<F>(0)), -infinity<F>(), value);
  return select(less(x, constant<F>(0)), not_a_number<F>(), value);
}

/// log2 of a double that is a float at least 0, to 2^-44 relative: s = (m - 1) / (m + 1).
template <class D> MS_INLINE D log2_of_float(D x) {
  using U = Bits<D>;
  using I = Int<D>;
  U bits = bit_cast<U>(x);
  I exponent = bit_cast<I>(bits - U(uint64_t(0x3fe6a09e667f3bcd))) >> I(int64_t(52));
  D m = bit_cast<D>(bits - (bit_cast<U>(exponent) << U(uint64_t(52))));
  D e = bit_cast<D>(bit_cast<U>(exponent) + U(uint64_t(0x4338000000000000))) - constant<D>(kRoundDouble);
  D s = (m - constant<D>(1)) / (m + constant<D>(1));
  D p = fused_polynomial(s * s, {0x1.71547652b8250p+1, 0x1.ec709dc53dcccp-1, 0x1.2776c291dc7ccp-1, 0x1.a61a2fc4ab265p-2,
                                 0x1.479531aa46ca8p-2, 0x1.21b2c8bab911ap-2});
  D value = fused(s, p, e);
  value = select(equal(x, constant<D>(0)), -infinity<D>(), value);
  return select(less(x, infinity<D>()), value, x);
}

/// 2^x to 2^-34 relative, |x| < 1000.
template <class D> MS_INLINE D exp2_for_float(D x) {
  using U = Bits<D>;
  D shifted = x + constant<D>(kRoundDouble);
  D f = x - (shifted - constant<D>(kRoundDouble));
  D p =
      fused_polynomial(f, {0x1.ffffffffab9c9p-1, 0x1.62e42ff1170bep-1, 0x1.ebfbe0a4f102cp-3, 0x1.c6b08aadbbf89p-5,
                           0x1.3b29dc15b3ba8p-7, 0x1.5d8a71a4d2984p-10, 0x1.446a42ec2fe80p-13, 0x1.fe16a315b6747p-17});
  return bit_cast<D>(bit_cast<U>(p) + (bit_cast<U>(shifted) << U(uint64_t(52))));
}

/// x^exponent of positive doubles within the range of floats, good enough to be rounded to one.
template <class D> MS_INLINE D power_of_double(D x, double exponent) {
  D power = log2_of_float(x) * constant<D>(exponent);
  power = select(less(power, constant<D>(-200)), constant<D>(-200), power);
  return exp2_for_float(select(less(constant<D>(200), power), constant<D>(200), power));
}

/// C's pow: |x|^y = 2^(y log2 |x|) in doubles, then the signs and the special cases.
template <class F> MS_INLINE F pow(F x, F y) {
  using D = Wide<double, width_of<F>>;
  F a = abs(x);
  D exponent = convert<D>(y) * log2_of_float(convert<D>(a));
  exponent = select(less(exponent, constant<D>(-200)), constant<D>(-200), exponent);
  exponent = select(less(constant<D>(200), exponent), constant<D>(200), exponent);
  F value = convert<F>(exp2_for_float(exponent));
  auto integral = equal(trunc(y), y);
  F half = y * constant<F>(0.5);
  auto odd = integral & !equal(trunc(half), half);
  value = select(odd & sign_is_set(x), -value, value);
  auto no_root = less(x, constant<F>(0)) & !integral & less(a, infinity<F>());
  value = select(no_root, not_a_number<F>(), value);
  value = select(is_nan(x) | is_nan(y), x + y, value);
  auto one =
      equal(y, constant<F>(0)) | equal(x, constant<F>(1)) | (equal(a, constant<F>(1)) & equal(abs(y), infinity<F>()));
  return select(one, constant<F>(1), value);
}

/// log x / log base, rounded once.
template <class F> MS_INLINE F log_to_base(F x, F base) {
  using D = Wide<double, width_of<F>>;
  F quotient = convert<F>(log2_of_float(convert<D>(abs(x))) / log2_of_float(convert<D>(abs(base))));
  auto defined = less_equal(constant<F>(0), x) & less_equal(constant<F>(0), base);
  return select(defined, quotient, not_a_number<F>());
}

// Remainder -----------------------------------------------------------------------------------------------------------

/// C's fmod where |x / y| < 2^22; beyond, some number less than |y| with the sign of x.
template <class F> MS_INLINE F fmod(F x, F y) {
  F b = abs(y), a = abs(x);
  // The quotient is at most one off, and the rest exact.
  F rest = fused(-floor(a / b), b, a);
  rest = select(less(rest, constant<F>(0)), rest + b, rest);
  rest = select(less_equal(b, rest), rest - b, rest);
  auto in_range = less_equal(constant<F>(0), rest) & less(rest, b);
  rest = select(in_range | is_nan(rest), rest, constant<F>(0));
  rest = select(equal(b, infinity<F>()) & less(a, b), a, rest);
  return copy_sign(rest, x);
}

} // namespace moonshade::stdlib::f32
