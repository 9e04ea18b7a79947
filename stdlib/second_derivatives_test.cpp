// Second derivatives of the library: values and columns against the first derivatives' own bits, the rest against
// central differences of the columns in double.
#include "stdlib/exports_for_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#define SECOND_DERIVATIVE(symbol, suffix, parameters) extern "C" void ms_##symbol##__2##suffix##_f64_w1();
#include "stdlib/second_derivatives.def"

namespace moonshade {
namespace {

using namespace test;
using Address = void (*)();
using Export = void (*)(void*, const void*, const void*, const void*, const void*, const void*, const void*,
                        const void*, const void*);

Address address_of(std::string_view symbol) {
#define SECOND_DERIVATIVE(symbol, suffix, parameters) {#symbol "__2" #suffix, ms_##symbol##__2##suffix##_f64_w1},
  static const std::pair<std::string_view, Address> kExports[] = {
#include "stdlib/second_derivatives.def"
  };
  return std::ranges::find(kExports, symbol, &std::pair<std::string_view, Address>::first)->second;
}

using Arguments = std::vector<std::vector<double>>;

/// All numbers of the results, in order.
std::vector<double> second(const LibrarySecondDerivative& row, const Arguments& arguments) {
  unsigned count = 0;
  for (unsigned i = 0; i < row.function.result_count; ++i)
    count += component_count(row.function.results[i]);
  std::vector<double> results(count, -1);
  const void* p[8] = {};
  for (size_t i = 0; i < arguments.size(); ++i)
    p[i] = arguments[i].data();
  reinterpret_cast<Export>(address_of(row.function.symbol))(results.data(), p[0], p[1], p[2], p[3], p[4], p[5], p[6],
                                                            p[7]);
  return results;
}

bool is_number(ValueType type) { return type != ValueType::Boolean && type != ValueType::Integer; }

/// Rows whose parameters are numbers, so that arguments can be drawn for them here.
bool has_numbers_alone(const LibraryFunction& row) {
  return std::all_of(row.parameters.begin(), row.parameters.begin() + row.parameter_count, is_number) &&
         std::all_of(row.results.begin(), row.results.begin() + row.result_count, is_number);
}

/// In 0.1 .. 0.9, where nearly all rows are smooth; the same for each call.
Arguments some_arguments(const LibraryFunction& row, std::mt19937& random) {
  Arguments arguments;
  for (unsigned i = 0; i < row.parameter_count; ++i) {
    arguments.emplace_back(component_count(row.parameters[i]));
    for (double& x : arguments.back())
      x = std::uniform_real_distribution<double>(0.1, 0.9)(random);
  }
  return arguments;
}

TEST(SecondDerivatives, AreTheLimitsOfDifferencesOfTheFirst) {
  if (!exports_can_run()) GTEST_SKIP();
  std::mt19937 random(11);
  unsigned rows = 0;
  for (const LibrarySecondDerivative& each : library_second_derivatives()) {
    const LibrarySecondDerivative* row = &each;
    const LibraryDerivative& first = *each.first;
    if (!has_numbers_alone(*first.row)) continue;
    ++rows;
    unsigned stride = 0;
    for (unsigned r = 0; r < first.row->result_count; ++r)
      stride += component_count(first.row->results[r]);
    unsigned compared = 0, all = 0;
    for (int point = 0; point < 16; ++point) {
      const Arguments at = some_arguments(*first.row, random);
      const std::vector<double> exact = second(*row, at);
      unsigned k = 0;
      for (unsigned i = 0; i < first.row->parameter_count; ++i) {
        for (unsigned c = 0; (first.parameters >> i & 1) != 0 && c < at[i].size(); ++c, ++k) {
          const auto moved = [&](double offset) {
            Arguments to = at;
            to[i][c] += offset;
            return second(*row, to);
          };
          constexpr double h = 1e-5;
          const std::vector<double> below = moved(-h), above = moved(h), far_below = moved(-2 * h),
                                    far_above = moved(2 * h);
          for (unsigned j = 0; j <= row->columns(); ++j)
            for (unsigned n = 0; n < stride; ++n) {
              const unsigned from = j * stride + n;
              const unsigned list = j == 0 ? 1 + k : row->list(j - 1, k);
              const double narrow = (above[from] - below[from]) / (2 * h);
              const double wide = (far_above[from] - far_below[from]) / (4 * h);
              const double scale = 1 + std::abs(narrow);
              ++all;
              if (!(std::abs(narrow - wide) < 1e-5 * scale)) continue; // a kink
              ++compared;
              EXPECT_NEAR(exact[list * stride + n], narrow, 2e-5 * scale)
                  << row->function.symbol << " column " << j << " by " << k;
            }
        }
      }
    }
    EXPECT_GT(compared, all / 2) << row->function.symbol;
  }
  EXPECT_GT(rows, 50u);
}

TEST(SecondDerivatives, AreThereForRowsOfNumbers) {
  const auto symbol = [](std::string_view name) {
    return [name](const LibraryDerivative& derivative) { return derivative.function.symbol == name; };
  };
  const LibraryDerivative& exp = *std::ranges::find_if(library_derivatives(), symbol("exp__d"));
  const std::vector<double> results = second(*library_second_derivative(exp), {{0.5}});
  ASSERT_EQ(results.size(), 3u);
  for (const double each : results)
    EXPECT_DOUBLE_EQ(each, std::exp(0.5));
  const LibraryDerivative& dot = *std::ranges::find_if(library_derivatives(), symbol("dot_vec3__d"));
  EXPECT_EQ(library_second_derivative(dot), nullptr);
}

TEST(SecondDerivatives, OrderIsInTheName) {
  EXPECT_EQ(export_order("noise_vec3"), 0u);
  EXPECT_EQ(export_order("ms_noise_vec3__d_f32_w16"), 1u);
  EXPECT_EQ(export_order("noise_vec3__2d"), 2u);
}

} // namespace
} // namespace moonshade
