// What the library's functions of floats are compared with: C's functions in double, whose own errors are far below
// half a unit in a float's last place, and the errors that are allowed. For math_f32_test.cpp, and for
// tests/exhaustive, which looks at every float.
#pragma once

#include "stdlib/hash.h"

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <string_view>

namespace moonshade::test {

/// |found - expected| in units in the last place of a float of that size; the sign of a zero counts, and all NaNs are
/// one.
inline double error_in_ulps(float found, double expected) {
  if (std::isnan(expected)) return std::isnan(found) ? 0 : INFINITY;
  const float rounded = float(expected);
  if (rounded == 0 && found == 0)
    return std::signbit(rounded) == std::signbit(found) ? std::abs(expected) * 0x1p149 : INFINITY;
  if (std::isinf(rounded) || std::isinf(found)) {
    // At the edge of overflow the greatest float is as good as infinity where the true value lies between.
    if (found == rounded) return 0;
    return std::abs(expected) > 0x1.fffffcp127 && std::abs(found) > 0x1.fffffcp127f ? 1 : INFINITY;
  }
  const int exponent = std::max(std::ilogb(expected == 0 ? double(std::numeric_limits<float>::min()) : expected), -126);
  return std::abs(double(found) - expected) / std::ldexp(1.0, exponent - 23);
}

/// The greatest error so far, and where.
struct WorstError {
  double error = 0;
  float x = 0, y = 0;
  void add(double e, float at, float second = 0) {
    if (!(e <= error)) error = e, x = at, y = second;
  }
};

// Of one number -------------------------------------------------------------------------------------------------------

struct OneNumber {
  std::string_view function; ///< its name in C++, that of the row but for hashes
  double (*reference)(double);
  double limit; ///< of the error, in units in the last place

  friend void PrintTo(const OneNumber& one, std::ostream* out) { *out << one.function; }
};

namespace references {
inline double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }
inline double below_one(double x) { return std::min(x - std::floor(x), 0x1.fffffep-1); } // what rounds to 1 stays below
inline double inverse_root(double x) { return 1 / std::sqrt(x); }
inline double to_radians(double x) { return x * (std::numbers::pi / 180); }
inline double to_degrees(double x) { return x * (180 / std::numbers::pi); }
inline double saturated(double x) { return x > 1 ? 1 : x < 0 ? 0 : x; }
inline double hashed(double x) { return stdlib::hash<double>(x); }
inline double decoded(double x) { return x > double(0.04045f) ? std::pow((x + 0.055) / 1.055, 2.4) : x / 12.92; }
inline double encoded(double x) { return x > double(0.0031308f) ? 1.055 * std::pow(x, 1 / 2.4) - 0.055 : x * 12.92; }
} // namespace references

inline constexpr OneNumber kOneNumber[] = {
    {"abs", std::abs, 0},
    {"sign", references::sign, 0},
    {"floor", std::floor, 0},
    {"ceil", std::ceil, 0},
    {"fract", references::below_one, 0.5},
    {"round", std::round, 0},
    {"trunc", std::trunc, 0},
    {"saturate", references::saturated, 0},
    {"exp", std::exp, 1.05},
    {"log", std::log, 1},
    {"sqrt", std::sqrt, 0.5},
    {"inversesqrt", references::inverse_root, 1.5},
    {"sin", std::sin, 1.6},
    {"cos", std::cos, 1.6},
    {"tan", std::tan, 2},
    {"asin", std::asin, 2},
    {"acos", std::acos, 2},
    {"atan", std::atan, 2},
    {"radians", references::to_radians, 1},
    {"degrees", references::to_degrees, 1},
    {"hash", references::hashed, 0},
    {"srgb2linear", references::decoded, 1},
    {"linear2srgb", references::encoded, 1},
};

// Of two numbers ------------------------------------------------------------------------------------------------------

/// A spread of floats by random bits: any, near 1, small integers, the special ones, 1/2 up to 1, and up to 32.
inline float some_float(uint64_t bits) {
  const uint32_t low = uint32_t(bits);
  switch (bits >> 61) {
  case 0:
    return std::bit_cast<float>(low);
  case 1:
    return std::bit_cast<float>(0x3f800000u + (low >> 20) - 2048);
  case 2:
    return float(int(low >> 24) - 128);
  case 3: {
    static const float special[] = {0.0f,      -0.0f,           1.0f, -1.0f, INFINITY, -INFINITY, NAN,
                                    0x1p-149f, 0x1.fffffep127f, 0.5f, -0.5f, 3.0f,     -3.0f};
    return special[(low >> 8) % std::size(special)];
  }
  case 4:
    return std::bit_cast<float>((low >> 8) + 0x3f000000u);
  default:
    return float(double(int32_t(low)) * 0x1p-26);
  }
}

/// Random bits of a counter.
inline uint64_t random_bits(uint64_t counter) {
  uint64_t x = (counter + 1) * 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

struct TwoNumbers {
  std::string_view symbol; ///< of the row
  double (*reference)(double, double);
  double limit;
  double quotients; ///< pairs whose quotient is greater are not compared

  bool compares(float x, float y) const { return !(std::abs(double(x) / double(y)) >= quotients); }
  friend void PrintTo(const TwoNumbers& two, std::ostream* out) { *out << two.symbol; }
};

namespace references {
inline double lua_mod(double a, double b) {
  const double m = std::fmod(a, b);
  return m * b < 0 ? m + b : m;
}
inline double log_of_base(double x, double base) { return std::log2(x) / std::log2(base); }
} // namespace references

inline constexpr TwoNumbers kTwoNumbers[] = {
    {"pow", std::pow, 0.51, INFINITY},
    {"atan2", std::atan2, 2, INFINITY},
    {"math_log_to_base", references::log_of_base, 0.51, INFINITY},
    {"math_fmod", std::fmod, 0, 0x1p22},
    {"mod", references::lua_mod, 0.5, 0x1p22},
};

} // namespace moonshade::test
