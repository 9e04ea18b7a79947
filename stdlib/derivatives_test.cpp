// Derivatives of the library: against central differences in double, the value's bits against the row's own, and the
// same bits at every width.
#include "stdlib/derivative.h"
#include "stdlib/exports_for_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

namespace moonshade {
namespace {

using namespace test;

constexpr unsigned kPoints = 256;

struct Sampler {
  std::mt19937_64 random{7};
  double uniform(double low, double high) { return low + (high - low) * double(random() >> 11) * 0x1p-53; }
};

bool is_number(ValueType type) { return type != ValueType::Boolean && type != ValueType::Integer; }

bool begins_with(std::string_view symbol, std::initializer_list<std::string_view> names) {
  return std::ranges::any_of(names, [&](std::string_view name) { return symbol.starts_with(name); });
}

/// A random argument where the row is smooth nearly everywhere.
double some_argument(Sampler& sampler, const LibraryFunction& row, unsigned parameter) {
  if (begins_with(row.symbol, {"turbulence", "fbm", "ridged", "hybrid", "warp"})) {
    // Three octaves and a fraction, of which the pixel sees the last in part.
    static constexpr std::array<std::array<double, 2>, 6> kRanges = {
        {{-20, 20}, {2.2, 3.8}, {0.8, 2.2}, {0.4, 1.2}, {0.02, 0.06}, {0.4, 1}}};
    return sampler.uniform(kRanges[parameter][0], kRanges[parameter][1]);
  }
  if (begins_with(row.symbol, {"noise", "perlin", "valuenoise", "worley"})) return sampler.uniform(-20, 20);
  if (begins_with(row.symbol, {"pgabor", "gabor"}) && parameter > 0) return sampler.uniform(1, 3);
  if (begins_with(row.symbol, {"pnoise", "pperlin", "pvaluenoise", "pworley"}) && parameter > 0)
    return sampler.uniform(1, 9);
  if (begins_with(row.symbol, {"atan", "math_atan", "mod", "op_mod", "math_fmod", "fract"}))
    return sampler.uniform(-3, 3);
  if (begins_with(row.symbol,
                  {"checker", "stripes", "tiles", "brick", "dots", "hexagons", "voronoi", "wood", "marble"}))
    return parameter == 0                            ? sampler.uniform(-20, 20)
           : row.symbol == "brick" && parameter == 5 ? sampler.uniform(1.5, 2.5)
                                                     : sampler.uniform(0.1, 0.3);
  if (row.symbol == "blackbody") return sampler.uniform(1500, 12000);
  if (begins_with(row.symbol, {"rgb2", "srgb2", "linear2"})) return sampler.uniform(0.1, 0.95);
  if (begins_with(row.symbol, {"asin", "acos", "math_asin", "math_acos"})) return sampler.uniform(-0.95, 0.95);
  if (begins_with(row.symbol, {"refract"})) return sampler.uniform(-0.6, 0.6);
  if (row.symbol == "clamp") return parameter == 0 ? sampler.uniform(-1, 2) : parameter == 1 ? 0.2 : 0.9;
  if (row.name.ends_with("step"))
    return parameter == 2   ? sampler.uniform(-1, 2)
           : parameter == 0 ? sampler.uniform(-0.5, 0.2)
                            : sampler.uniform(1, 2);
  if (begins_with(row.symbol, {"log", "math_log", "pow", "op_pow", "sqrt", "math_sqrt", "inversesqrt", "bias", "gain"}))
    return sampler.uniform(0.1, 0.95);
  return sampler.uniform(-2, 2);
}

double& number(Column& column, unsigned component, unsigned point) {
  return reinterpret_cast<double*>(column.bytes.data())[component * kPoints + point];
}
double number(const Column& column, unsigned component, unsigned point) {
  return reinterpret_cast<const double*>(column.bytes.data())[component * kPoints + point];
}

std::vector<Column> some_arguments(Sampler& sampler, const LibraryFunction& row, Precision precision) {
  std::vector<Column> arguments;
  for (unsigned i = 0; i < row.parameter_count; ++i) {
    const ValueType type = row.parameters[i];
    arguments.push_back(
        {type, std::vector<unsigned char>(component_count(type) * component_size(type, precision) * kPoints)});
    for (unsigned k = 0; k < component_count(type) * kPoints; ++k) {
      const double value = some_argument(sampler, row, i);
      const auto narrow = float(value);
      const auto integer = int64_t(value * 10);
      unsigned char* to = arguments.back().bytes.data() + k * component_size(type, precision);
      if (type == ValueType::Boolean)
        *to = value > 0;
      else if (type == ValueType::Integer)
        std::memcpy(to, &integer, sizeof integer);
      else if (precision == Precision::F32)
        std::memcpy(to, &narrow, sizeof narrow);
      else
        std::memcpy(to, &value, sizeof value);
    }
  }
  return arguments;
}

/// Columns one after the other, of what is no number as zeros.
std::vector<double> numbers_of(std::span<const Column> columns) {
  std::vector<double> numbers;
  for (const Column& column : columns)
    for (unsigned c = 0; c < component_count(column.type); ++c)
      for (unsigned point = 0; point < kPoints; ++point)
        numbers.push_back(is_number(column.type) ? number(column, c, point) : 0);
  return numbers;
}

/// Central differences of a row by one component of one argument, by component of its results (one result's after the
/// other's) and point; NaN where the row is not smooth.
std::vector<std::vector<double>> differences(const LibraryFunction& row, std::vector<Column> arguments,
                                             unsigned parameter, unsigned component) {
  const double h = 5e-6;
  const Column original = arguments[parameter];
  const auto at = [&](double offset) {
    for (unsigned point = 0; point < kPoints; ++point)
      number(arguments[parameter], component, point) = number(original, component, point) + offset;
    return numbers_of(run_export(row, Precision::F64, 1, arguments, kPoints));
  };
  const std::vector<double> far_below = at(-2 * h), below = at(-h), above = at(h), far_above = at(2 * h);
  std::vector<std::vector<double>> result(above.size() / kPoints, std::vector<double>(kPoints));
  for (unsigned c = 0; c < result.size(); ++c)
    for (unsigned point = 0; point < kPoints; ++point) {
      const size_t at = c * kPoints + point;
      const double narrow = (above[at] - below[at]) / (2 * h);
      const double wide = (far_above[at] - far_below[at]) / (4 * h);
      const bool smooth = std::abs(narrow - wide) < 1e-5 * (1 + std::abs(narrow));
      result[c][point] = smooth ? (4 * narrow - wide) / 3 : std::nan("");
    }
  return result;
}

/// Whether a component of the results, one result's after the other's, can depend on a column.
bool is_used(const LibraryDerivative& derivative, unsigned column, unsigned component) {
  unsigned result = 0;
  for (; component >= component_count(derivative.row->results[result]); ++result)
    component -= component_count(derivative.row->results[result]);
  return (derivative.used[derivative.index(column, result)] >> component & 1) != 0;
}

TEST(Derivatives, AreTheLimitsOfDifferences) {
  if (!exports_can_run()) GTEST_SKIP();
  Sampler sampler;
  for (const LibraryDerivative& derivative : library_derivatives()) {
    const LibraryFunction& row = *derivative.row;
    const std::vector<Column> arguments = some_arguments(sampler, row, Precision::F64);
    const std::vector<Column> results = run_export(derivative.function, Precision::F64, 1, arguments, kPoints);
    unsigned column = 0, compared = 0, components = 0;
    for (unsigned r = 0; r < row.result_count; ++r)
      components += component_count(row.results[r]);
    double worst = 0;
    for (unsigned i = 0; i < row.parameter_count; ++i) {
      if ((derivative.parameters >> i & 1) == 0) continue;
      for (unsigned k = 0; k < component_count(row.parameters[i]); ++k, ++column) {
        const auto expected = differences(row, arguments, i, k);
        const auto slopes = numbers_of(std::span(results).subspan((1 + column) * row.result_count, row.result_count));
        for (unsigned c = 0; c < expected.size(); ++c)
          for (unsigned point = 0; point < kPoints; ++point) {
            const double exact = slopes[c * kPoints + point], difference = expected[c][point];
            if (!is_used(derivative, column, c)) {
              EXPECT_EQ(exact, 0) << derivative.function.symbol;
            }
            if (std::isnan(difference)) continue;
            worst = std::max(worst, std::abs(exact - difference) / (1 + std::abs(difference)));
            ++compared;
          }
      }
    }
    EXPECT_EQ((1 + column) * row.result_count, derivative.function.result_count);
    EXPECT_LT(worst, 2e-6) << derivative.function.symbol;
    EXPECT_GT(compared, 3 * column * components * kPoints / 4) << derivative.function.symbol;
  }
}

/// Rows and parameters that derivatives.def leaves out are constant wherever they are smooth.
TEST(Derivatives, LeaveOutOnlyWhatIsConstant) {
  if (!exports_can_run()) GTEST_SKIP();
  for (const LibraryFunction& row : library()) {
    Sampler sampler; // its own, so that no row's points depend on the rows before it
    if (!is_number(row.results[0])) continue;
    const std::vector<Column> arguments = some_arguments(sampler, row, Precision::F64);
    for (unsigned i = 0; i < row.parameter_count; ++i) {
      if (!is_number(row.parameters[i]) || library_derivative(row, 1u << i) != nullptr) continue;
      if (row.name == "hash") continue;                               // random at every step
      if (row.name == "inverse" || row.name == "transpose") continue; // the compiler's own
      const auto expected = differences(row, arguments, i, 0);
      for (const auto& component : expected)
        for (const double difference : component)
          if (!std::isnan(difference)) {
            EXPECT_EQ(difference, 0) << row.symbol << " by parameter " << i;
          }
    }
  }
}

TEST(Derivatives, AreFoundByWhatIsAskedFor) {
  const auto found = [](std::string_view symbol, unsigned parameters) {
    const LibraryFunction& row = *std::ranges::find(library(), symbol, &LibraryFunction::symbol);
    const LibraryDerivative* derivative = library_derivative(row, parameters);
    return derivative == nullptr ? "none" : std::string(derivative->function.symbol);
  };
  EXPECT_EQ(found("pow", 0b01), "pow__d");
  EXPECT_EQ(found("pow", 0b10), "pow__dd");
  EXPECT_EQ(found("fbm_vec3", 0b0001), "fbm_vec3__d");
  EXPECT_EQ(found("fbm_vec3", 0b0011), "fbm_vec3__dd");
  EXPECT_EQ(found("pnoise_vec3", 0b10), "none");
  EXPECT_EQ(found("floor", 0b1), "none");
}

TEST(Derivatives, KnowWhatIsZeroForEveryArgument) {
  const LibraryFunction& cross = library_overloads("cross")[0];
  const LibraryDerivative& derivative = *library_derivative(cross, 0b01);
  EXPECT_EQ(derivative.used[0], 0b110); // by a.x: (0, -b.z, b.y)
  EXPECT_EQ(derivative.used[1], 0b101);
  EXPECT_EQ(derivative.used[5], 0b011); // by b.z
}

/// The bits of a column; NaNs alike.
std::vector<unsigned char> bits_of(Column column, Precision precision) {
  const unsigned size = component_size(column.type, precision);
  if (!is_number(column.type)) return column.bytes;
  for (size_t i = 0; i < column.bytes.size(); i += size) {
    float narrow;
    double wide;
    std::memcpy(&narrow, column.bytes.data() + i, 4);
    if (size == 8) std::memcpy(&wide, column.bytes.data() + i, 8);
    if (size == 8 ? std::isnan(wide) : std::isnan(narrow)) std::fill_n(column.bytes.begin() + long(i), size, 0xff);
  }
  return column.bytes;
}

/// Random arguments, some of them awkward.
std::vector<Column> awkward_arguments(Sampler& sampler, const LibraryFunction& row, Precision precision) {
  static const double kAwkward[] = {0, -0.0, 1, -1, 2, 0.5, 1e30, -1e30, INFINITY, -INFINITY, NAN, 1e-40, 255, 1e5};
  std::vector<Column> arguments = some_arguments(sampler, row, precision);
  for (Column& column : arguments) {
    if (!is_number(column.type)) continue;
    const unsigned size = component_size(column.type, precision);
    for (size_t i = 0; i < column.bytes.size(); i += size) {
      if (sampler.random() % 4 != 0) continue;
      const double value = kAwkward[sampler.random() % std::size(kAwkward)];
      const auto narrow = float(value);
      std::memcpy(column.bytes.data() + i, size == 4 ? static_cast<const void*>(&narrow) : &value, size);
    }
  }
  return arguments;
}

class DerivativeExports : public testing::TestWithParam<Precision> {};

TEST_P(DerivativeExports, GiveTheRowsOwnValueAndTheSameBitsAtEveryWidth) {
  if (!exports_can_run()) GTEST_SKIP();
  Sampler sampler;
  for (const LibraryDerivative& derivative : library_derivatives()) {
    const std::vector<Column> arguments = awkward_arguments(sampler, *derivative.row, GetParam());
    const std::vector<Column> plain = run_export(*derivative.row, GetParam(), 1, arguments, kPoints);
    const std::vector<Column> expected = run_export(derivative.function, GetParam(), 1, arguments, kPoints);
    for (size_t i = 0; i < plain.size(); ++i)
      EXPECT_EQ(bits_of(plain[i], GetParam()), bits_of(expected[i], GetParam())) << derivative.function.symbol;
    for (const unsigned width : kWidths) {
      const std::vector<Column> results = run_export(derivative.function, GetParam(), width, arguments, kPoints);
      for (size_t i = 0; i < results.size(); ++i)
        EXPECT_EQ(bits_of(results[i], GetParam()), bits_of(expected[i], GetParam()))
            << derivative.function.symbol << " result " << i << " on " << width << " lanes";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Precisions, DerivativeExports, testing::Values(Precision::F32, Precision::F64),
                         [](const auto& info) { return testing::PrintToString(info.param); });

/// What dual.h states.
template <class Row, unsigned Active, class... A> double slope(A... arguments) {
  return stdlib::Derivative<Row, Active, double>::of(arguments...).d[0];
}
#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) MS_ROW(symbol, function, type)
#define DEFAULTS(...)
namespace rows {
using namespace stdlib;
#include "stdlib/table.def"
} // namespace rows

TEST(Derivatives, AtKinksAreThoseOfTheBranchTaken) {
  using stdlib::Vec;
  EXPECT_EQ((slope<rows::Row_abs, 1>(0.0)), 1);
  EXPECT_EQ((slope<rows::Row_abs, 1>(-0.0)), -1);
  EXPECT_EQ((slope<rows::Row_min, 0b01>(2.0, 2.0)), 1);
  EXPECT_EQ((slope<rows::Row_min, 0b10>(2.0, 2.0)), 0);
  EXPECT_EQ((slope<rows::Row_clamp, 0b001>(3.0, 0.0, 1.0)), 0);
  EXPECT_EQ((slope<rows::Row_fract, 1>(3.0)), 1);
  EXPECT_EQ((slope<rows::Row_sqrt, 1>(0.0)), 0);
  EXPECT_EQ((slope<rows::Row_asin, 1>(1.0)), 0);
  EXPECT_EQ((slope<rows::Row_atan2, 0b01>(0.0, 0.0)), 0);
  EXPECT_EQ((slope<rows::Row_pow, 0b01>(0.0, 1.0)), 1);
  EXPECT_EQ((slope<rows::Row_pow, 0b01>(0.0, 0.5)), 0);
  EXPECT_EQ((slope<rows::Row_pow, 0b01>(-3.0, 2.0)), -6);
  EXPECT_EQ((slope<rows::Row_length_vec3, 1>(Vec<3, double>{{0.0, 0.0, 0.0}})), 0);
}

} // namespace
} // namespace moonshade
