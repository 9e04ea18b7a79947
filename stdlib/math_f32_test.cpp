// The kernels for floats against C's functions in double, over every 997th float and around the hard places: the
// greatest error in units in the last place. C's double results are good to far below half of one such unit.
// scripts/exhaustive runs them over every float (MOONSHADE_FLOAT_STRIDE=1).
#include "stdlib/exports_for_test.h"
#include "stdlib/numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numbers>

namespace moonshade {
namespace {

using namespace test;

constexpr unsigned kWidth = 16;
using Block = float __attribute__((ext_vector_type(16)));

float float_of(uint32_t bits) { return std::bit_cast<float>(bits); }

/// |found - expected| in units in the last place of a float of that size.
double error_in_ulps(float found, double expected) {
  if (std::isnan(expected)) return std::isnan(found) ? 0 : INFINITY;
  float rounded = float(expected);
  if (std::isinf(rounded) || std::isinf(found)) {
    // At the edge of overflow the greatest float is as good as infinity where the true value lies between.
    if (found == rounded) return 0;
    return std::abs(expected) > 0x1.fffffcp127 && std::abs(found) > 0x1.fffffcp127f ? 1 : INFINITY;
  }
  int exponent = std::max(std::ilogb(expected == 0 ? double(std::numeric_limits<float>::min()) : expected), -126);
  return std::abs(double(found) - expected) / std::ldexp(1.0, exponent - 23);
}

struct Worst {
  double error = 0;
  float x = 0, y = 0;
  void add(double e, float at, float second = 0) {
    if (!(e <= error)) error = e, x = at, y = second;
  }
};

void* export_of(const char* symbol) {
  for (const LibraryFunction& row : library())
    if (row.symbol == symbol) return export_address(row, Precision::F32, kWidth);
  return nullptr;
}

/// Every how many floats are looked at.
uint64_t float_stride() {
  const char* stride = std::getenv("MOONSHADE_FLOAT_STRIDE");
  return stride == nullptr ? 997 : std::max(1ull, std::strtoull(stride, nullptr, 10));
}

Worst worst_of_one(const char* symbol, double (*reference)(double)) {
  auto function = reinterpret_cast<void (*)(void*, const void*)>(export_of(symbol));
  Worst worst;
  const uint64_t stride = float_stride();
  for (uint64_t bits = 0; bits < 0x1'0000'0000; bits += kWidth * stride) {
    Block x, y;
    for (unsigned i = 0; i < kWidth; ++i)
      x[i] = float_of(uint32_t(bits + i * stride));
    function(&y, &x);
    for (unsigned i = 0; i < kWidth; ++i)
      worst.add(error_in_ulps(y[i], reference(double(x[i]))), x[i]);
  }
  return worst;
}

struct One {
  const char* symbol;
  double (*reference)(double);
  double limit;
};

class OneNumber : public testing::TestWithParam<One> {};

TEST_P(OneNumber, IsWithinTheStatedError) {
  if (!exports_can_run()) GTEST_SKIP() << "the machine lacks AVX2 or FMA";
  Worst worst = worst_of_one(GetParam().symbol, GetParam().reference);
  RecordProperty("worst", std::to_string(worst.error));
  std::printf("%s: %.3f ulp at %a\n", GetParam().symbol, worst.error, double(worst.x));
  EXPECT_LE(worst.error, GetParam().limit) << "at " << std::hexfloat << worst.x;
}

double inverse_root(double x) { return 1 / std::sqrt(x); }
double to_radians(double x) { return x * (std::numbers::pi / 180); }
double to_degrees(double x) { return x * (180 / std::numbers::pi); }
double below_one(double x) {
  return std::min(x - std::floor(x), 0x1.fffffep-1); // what rounds to 1 stays below
}

INSTANTIATE_TEST_SUITE_P(Kernels, OneNumber,
                         testing::Values(One{"sin", std::sin, 1.6}, One{"cos", std::cos, 1.6}, One{"tan", std::tan, 2},
                                         One{"asin", std::asin, 2}, One{"acos", std::acos, 2},
                                         One{"atan", std::atan, 2}, One{"exp", std::exp, 1}, One{"log", std::log, 1},
                                         One{"sqrt", std::sqrt, 0.5}, One{"inversesqrt", inverse_root, 1.5},
                                         One{"radians", to_radians, 1}, One{"degrees", to_degrees, 1},
                                         One{"floor", std::floor, 0}, One{"ceil", std::ceil, 0},
                                         One{"trunc", std::trunc, 0}, One{"round", std::round, 0},
                                         One{"fract", below_one, 0.5}),
                         [](const auto& info) { return std::string(info.param.symbol); });

/// A spread of floats: magnitudes over all exponents, near 1, integers, and the special ones.
float some_float(uint32_t i) {
  uint32_t bits = i * 0x9e3779b9u;
  switch (i % 8) {
  case 0:
    return float_of(bits);
  case 1:
    return float_of(0x3f800000u + (bits >> 20) - 2048);
  case 2:
    return float(int(bits >> 24) - 128);
  case 3: {
    static const float special[] = {0.0f,      -0.0f,           1.0f, -1.0f, INFINITY, -INFINITY, NAN,
                                    0x1p-149f, 0x1.fffffep127f, 0.5f, -0.5f, 3.0f,     -3.0f};
    return special[(bits >> 8) % std::size(special)];
  }
  case 4:
    return float_of((bits >> 9) | 0x3f000000u);
  default:
    return float(double(int32_t(bits)) * 0x1p-26);
  }
}

Worst worst_of_two(const char* symbol, double (*reference)(double, double)) {
  auto function = reinterpret_cast<void (*)(void*, const void*, const void*)>(export_of(symbol));
  Worst worst;
  for (uint32_t n = 0; n < 3'000'000; n += kWidth) {
    Block x, y, z;
    for (unsigned i = 0; i < kWidth; ++i)
      x[i] = some_float(n + i), y[i] = some_float((n + i) * 2654435761u >> 3);
    function(&z, &x, &y);
    for (unsigned i = 0; i < kWidth; ++i)
      worst.add(error_in_ulps(z[i], reference(double(x[i]), double(y[i]))), x[i], y[i]);
  }
  return worst;
}

TEST(TwoNumbers, PowIsWithinOneUlp) {
  if (!exports_can_run()) GTEST_SKIP() << "the machine lacks AVX2 or FMA";
  Worst worst = worst_of_two("pow", std::pow);
  EXPECT_LE(worst.error, 0.51) << std::hexfloat << worst.x << " " << worst.y;
}

TEST(TwoNumbers, AtanIsWithinTwoUlps) {
  if (!exports_can_run()) GTEST_SKIP() << "the machine lacks AVX2 or FMA";
  Worst worst = worst_of_two("atan2", std::atan2);
  EXPECT_LE(worst.error, 2) << std::hexfloat << worst.x << " " << worst.y;
}

double logarithm(double x, double base) { return std::log2(x) / std::log2(base); }

TEST(TwoNumbers, LogToABaseIsWithinOneUlp) {
  if (!exports_can_run()) GTEST_SKIP() << "the machine lacks AVX2 or FMA";
  Worst worst = worst_of_two("math_log_to_base", logarithm);
  EXPECT_LE(worst.error, 0.51) << std::hexfloat << worst.x << " " << worst.y;
}

TEST(TwoNumbers, SignsOfZerosAreThoseOfC) {
  using namespace stdlib;
  for (float x : {0.0f, -0.0f}) {
    EXPECT_EQ(std::signbit(stdlib::sin(x)), std::signbit(x));
    EXPECT_EQ(std::signbit(stdlib::tan(x)), std::signbit(x));
    EXPECT_EQ(std::signbit(stdlib::asin(x)), std::signbit(x));
    EXPECT_EQ(std::signbit(stdlib::atan(x)), std::signbit(x));
    for (float y : {0.0f, -0.0f, 1.0f, -1.0f})
      EXPECT_EQ(stdlib::atan2(x, y), float(std::atan2(double(x), double(y)))) << x << " " << y;
    EXPECT_EQ(std::signbit(stdlib::pow(x, 3.0f)), std::signbit(x));
    EXPECT_EQ(std::signbit(stdlib::pow(x, -3.0f)), std::signbit(x));
    EXPECT_FALSE(std::signbit(stdlib::pow(x, 2.5f)));
  }
}

TEST(Fmod, IsExactForQuotientsOfOrdinarySize) {
  for (uint32_t n = 0; n < 400'000; ++n) {
    float x = some_float(n), y = some_float(n * 2654435761u >> 3);
    double quotient = std::abs(double(x) / double(y));
    float found = stdlib::fmod(x, y), expected = std::fmod(x, y);
    if (std::isnan(expected))
      EXPECT_TRUE(std::isnan(found)) << x << " " << y;
    else if (!(quotient >= 0x1p22))
      EXPECT_EQ(found, expected) << std::hexfloat << x << " " << y;
    else
      EXPECT_LT(std::abs(found), std::abs(y)) << std::hexfloat << x << " " << y;
  }
}

} // namespace
} // namespace moonshade
