// The functions of floats against C's functions in double, over every 997th float and, of two numbers, around the hard
// places: the greatest error in units in the last place. scripts/exhaustive looks at every float.
#include "stdlib/exports_for_test.h"
#include "stdlib/float_errors_for_test.h"
#include "stdlib/numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace moonshade {
namespace {

using namespace test;

constexpr unsigned kWidth = 16;
using Block = float __attribute__((ext_vector_type(16)));

float float_of(uint32_t bits) { return std::bit_cast<float>(bits); }

void* export_of(std::string_view symbol) {
  for (const LibraryFunction& row : library())
    if (row.symbol == symbol) return export_address(row, Precision::F32, kWidth);
  return nullptr;
}

WorstError worst_of_one(const OneNumber& one) {
  auto function = reinterpret_cast<void (*)(void*, const void*)>(export_of(one.function));
  WorstError worst;
  constexpr uint64_t kStride = 997;
  for (uint64_t bits = 0; bits < 0x1'0000'0000; bits += kWidth * kStride) {
    Block x, y;
    for (unsigned i = 0; i < kWidth; ++i)
      x[i] = float_of(uint32_t(bits + i * kStride));
    function(&y, &x);
    for (unsigned i = 0; i < kWidth; ++i)
      worst.add(error_in_ulps(y[i], one.reference(double(x[i]))), x[i]);
  }
  return worst;
}

class FunctionOfOneNumber : public testing::TestWithParam<OneNumber> {};

TEST_P(FunctionOfOneNumber, IsWithinTheStatedError) {
  if (!exports_can_run()) GTEST_SKIP() << "the machine lacks AVX2 or FMA";
  if (GetParam().function == "hash") GTEST_SKIP() << "of several types; exports_test compares it";
  const WorstError worst = worst_of_one(GetParam());
  RecordProperty("worst", std::to_string(worst.error));
  EXPECT_LE(worst.error, GetParam().limit) << "at " << std::hexfloat << worst.x;
}

INSTANTIATE_TEST_SUITE_P(Kernels, FunctionOfOneNumber, testing::ValuesIn(kOneNumber),
                         [](const auto& info) { return std::string(info.param.function); });

class FunctionOfTwoNumbers : public testing::TestWithParam<TwoNumbers> {};

TEST_P(FunctionOfTwoNumbers, IsWithinTheStatedError) {
  if (!exports_can_run()) GTEST_SKIP() << "the machine lacks AVX2 or FMA";
  auto function = reinterpret_cast<void (*)(void*, const void*, const void*)>(export_of(GetParam().symbol));
  WorstError worst;
  for (uint32_t n = 0; n < 3'000'000; n += kWidth) {
    Block x, y, z;
    for (unsigned i = 0; i < kWidth; ++i)
      x[i] = some_float(random_bits(2 * (n + i))), y[i] = some_float(random_bits(2 * (n + i) + 1));
    function(&z, &x, &y);
    for (unsigned i = 0; i < kWidth; ++i)
      if (GetParam().compares(x[i], y[i]))
        worst.add(error_in_ulps(z[i], GetParam().reference(double(x[i]), double(y[i]))), x[i], y[i]);
  }
  EXPECT_LE(worst.error, GetParam().limit) << std::hexfloat << worst.x << " " << worst.y;
}

INSTANTIATE_TEST_SUITE_P(Kernels, FunctionOfTwoNumbers, testing::ValuesIn(kTwoNumbers),
                         [](const auto& info) { return std::string(info.param.symbol); });

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

TEST(Fmod, StaysBelowTheDivisorForGreatQuotients) {
  for (uint32_t n = 0; n < 400'000; ++n) {
    const float x = some_float(random_bits(2 * n)), y = some_float(random_bits(2 * n + 1));
    const float found = stdlib::fmod(x, y);
    if (!std::isnan(std::fmod(x, y)) && std::abs(double(x) / double(y)) >= 0x1p22)
      EXPECT_LT(std::abs(found), std::abs(y)) << std::hexfloat << x << " " << y;
  }
}

} // namespace
} // namespace moonshade
