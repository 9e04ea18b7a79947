// Every row of the table, at every width and in both precisions, over random and awkward arguments: the lanes of wide
// code give the bits that one lane gives, and one lane gives what the same templates give as native code of the
// machine's baseline (which is what stock Lua calls).
#include "stdlib/exports_for_test.h"
#include "stdlib/signature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace moonshade {
namespace {

using namespace test;
using namespace stdlib;

constexpr unsigned kPoints = 4096;

// Arguments
// -------------------------------------------------------------------------------------------------------------

template <class T> T awkward_number(std::mt19937_64& random) {
  using Limits = std::numeric_limits<T>;
  static const T values[] = {0,
                             -T(0),
                             1,
                             -1,
                             T(0.5),
                             T(-0.5),
                             2,
                             3,
                             -3,
                             T(0x1p23),
                             T(-0x1p23),
                             T(0x1p31),
                             T(0x1p52),
                             T(0x1p53),
                             T(0x1p63),
                             T(-0x1p63),
                             T(0x1p64),
                             T(1e10),
                             T(-1e30),
                             Limits::infinity(),
                             -Limits::infinity(),
                             Limits::quiet_NaN(),
                             Limits::min(),
                             Limits::denorm_min(),
                             -Limits::denorm_min(),
                             Limits::max(),
                             Limits::lowest(),
                             Limits::epsilon(),
                             T(3.14159265358979),
                             T(1.57079632679489),
                             T(131072),
                             T(1e20),
                             T(0.49999997),
                             T(255),
                             T(256)};
  return values[random() % std::size(values)];
}

template <class T> T some_number(std::mt19937_64& random) {
  auto uniform = [&](double low, double high) { return T(low + (high - low) * double(random() >> 11) * 0x1p-53); };
  switch (random() % 8) {
  case 0:
    return awkward_number<T>(random);
  case 1: {
    T value;
    uint64_t bits = random();
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  case 2:
    return T(int(random() % 41) - 20);
  case 3:
    return uniform(-1000, 1000);
  case 4:
    return std::exp2(uniform(-40, 40));
  default:
    return uniform(-4, 4);
  }
}

int64_t some_integer(std::mt19937_64& random) {
  static const int64_t values[] = {0,
                                   1,
                                   -1,
                                   2,
                                   -2,
                                   7,
                                   63,
                                   64,
                                   65,
                                   -63,
                                   -64,
                                   -65,
                                   1 << 24,
                                   (1 << 24) + 1,
                                   INT64_MAX,
                                   INT64_MIN,
                                   INT64_MAX - 1,
                                   INT64_MIN + 1,
                                   int64_t(1) << 53,
                                   (int64_t(1) << 53) + 1};
  switch (random() % 4) {
  case 0:
    return values[random() % std::size(values)];
  case 1:
    return int64_t(random());
  default:
    return int64_t(random() % 201) - 100;
  }
}

Column some_column(ValueType type, Precision precision, std::mt19937_64& random) {
  unsigned size = component_size(type, precision);
  Column column = {type, std::vector<unsigned char>(size * component_count(type) * kPoints)};
  for (size_t i = 0; i < column.bytes.size(); i += size) {
    int64_t integer = some_integer(random);
    float f = some_number<float>(random);
    double d = some_number<double>(random);
    const void* from = type == ValueType::Integer    ? static_cast<const void*>(&integer)
                       : precision == Precision::F32 ? static_cast<const void*>(&f)
                                                     : static_cast<const void*>(&d);
    std::memcpy(&column.bytes[i], from, size);
  }
  return column;
}

// Comparison
// ------------------------------------------------------------------------------------------------------------

/// A component as text: the same for all NaNs, otherwise its bits.
std::string text_of(const unsigned char* at, ValueType type, Precision precision) {
  char text[64];
  if (type == ValueType::Boolean) return at[0] == 1 ? "true" : at[0] == 0 ? "false" : "no boolean";
  if (type == ValueType::Integer) {
    int64_t value;
    std::memcpy(&value, at, sizeof value);
    return std::to_string(value);
  }
  double value;
  float f;
  if (precision == Precision::F32)
    std::memcpy(&f, at, sizeof f), value = f;
  else
    std::memcpy(&value, at, sizeof value);
  if (std::isnan(value)) return "nan";
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

/// How the first differing component of a column differs; empty where none does.
std::string difference(const Column& expected, const Column& found, Precision precision) {
  unsigned size = component_size(expected.type, precision);
  for (size_t i = 0; i < expected.bytes.size(); i += size) {
    if (std::memcmp(&expected.bytes[i], &found.bytes[i], size) == 0) continue;
    std::string a = text_of(&expected.bytes[i], expected.type, precision);
    std::string b = text_of(&found.bytes[i], expected.type, precision);
    if (a != b) return "point " + std::to_string(i / size % kPoints) + ": " + a + " became " + b;
  }
  return {};
}

std::string arguments_at(std::span<const Column> arguments, Precision precision, const std::string& difference) {
  unsigned point = unsigned(std::stoul(difference.substr(6)));
  std::string text = " for";
  for (const Column& column : arguments) {
    unsigned size = component_size(column.type, precision);
    for (unsigned c = 0; c < component_count(column.type); ++c)
      text += " " + text_of(&column.bytes[size_t(size) * (c * kPoints + point)], column.type, precision);
  }
  return text;
}

std::vector<Column> arguments_of(const LibraryFunction& row, Precision precision, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<Column> arguments;
  for (unsigned i = 0; i < row.parameter_count; ++i)
    arguments.push_back(some_column(row.parameters[i], precision, random));
  return arguments;
}

TEST(Exports, AllWidthsGiveTheBitsOfOneLane) {
  if (!exports_can_run()) GTEST_SKIP() << "the machine lacks AVX2 or FMA";
  for (const LibraryFunction& row : library()) {
    for (Precision precision : {Precision::F32, Precision::F64}) {
      auto arguments = arguments_of(row, precision, 1);
      auto expected = run_export(row, precision, 1, arguments, kPoints);
      for (unsigned width : {4u, 8u, 16u, 32u}) {
        auto found = run_export(row, precision, width, arguments, kPoints);
        for (unsigned r = 0; r < row.result_count; ++r) {
          std::string wrong = difference(expected[r], found[r], precision);
          EXPECT_EQ(wrong, "") << row.symbol << (precision == Precision::F32 ? " f32" : " f64") << " width " << width
                               << arguments_at(arguments, precision, wrong);
        }
      }
    }
  }
}

// The templates themselves
// ----------------------------------------------------------------------------------------------

template <int N, class L> auto& component_at(Vec<N, L>& v, unsigned c) { return v[int(c)]; }
template <int N, class L> auto& component_at(const Vec<N, L>& v, unsigned c) { return v[int(c)]; }
template <int N, class L> auto& component_at(Mat<N, L>& m, unsigned c) { return m[int(c) / N][int(c) % N]; }
template <int N, class L> auto& component_at(const Mat<N, L>& m, unsigned c) { return m[int(c) / N][int(c) % N]; }

/// Reads and writes one point of a column as a value of C++.
template <class T, class L> T read(const Column& column, unsigned point) {
  T value;
  auto component = [&](unsigned c, auto& to) {
    std::memcpy(&to, &column.bytes[sizeof to * (c * kPoints + point)], sizeof to);
  };
  if constexpr (std::is_same_v<T, L> || std::is_same_v<T, int64_t>)
    component(0, value);
  else
    for (unsigned c = 0; c < sizeof value / sizeof(L); ++c)
      component(c, component_at(value, c));
  return value;
}
template <class L, class T> void write(Column& column, unsigned point, const T& value) {
  auto component = [&](unsigned c, const auto& from) {
    std::memcpy(&column.bytes[sizeof from * (c * kPoints + point)], &from, sizeof from);
  };
  if constexpr (std::is_same_v<T, L> || std::is_same_v<T, int64_t>)
    component(0, value);
  else if constexpr (std::is_same_v<T, Mask<L>>)
    component(0, static_cast<unsigned char>(value.bits));
  else
    for (unsigned c = 0; c < sizeof value / sizeof(L); ++c)
      component(c, component_at(value, c));
}
template <class L, class T> void write_all(std::vector<Column>& results, unsigned point, const T& value) {
  write<L>(results[0], point, value);
}
template <class L, class... T>
void write_all(std::vector<Column>& results, unsigned point, const Results<T...>& values) {
  size_t next = 0;
  for_each_result(values, [&](const auto& value) { write<L>(results[next++], point, value); });
}

template <class Row, class L, class... P> struct Native {
  static void run(std::span<const Column> arguments, std::vector<Column>& results) {
    [&]<size_t... I>(std::index_sequence<I...>) {
      for (unsigned point = 0; point < kPoints; ++point)
        write_all<L>(results, point, Row::call(read<P, L>(arguments[I], point)...));
    }(std::index_sequence_for<P...>());
  }
};
template <class Row, class L> struct NativeOf {
  template <class... P> using With = Native<Row, L, P...>;
  using Type = typename Signature<typename Row::Type>::template Parameters<With>;
};

template <class Row, class L> void expect_native_agrees(const LibraryFunction& row) {
  Precision precision = is_f32<L> ? Precision::F32 : Precision::F64;
  auto arguments = arguments_of(row, precision, 2);
  auto expected = run_export(row, precision, 1, arguments, kPoints);
  auto found = expected;
  for (Column& column : found)
    std::fill(column.bytes.begin(), column.bytes.end(), 0x5a);
  NativeOf<Row, L>::Type::run(arguments, found);
  for (unsigned r = 0; r < row.result_count; ++r) {
    std::string wrong = difference(expected[r], found[r], precision);
    EXPECT_EQ(wrong, "") << row.symbol << (is_f32<L> ? " f32" : " f64") << arguments_at(arguments, precision, wrong);
  }
}

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) MS_ROW(symbol, function, type)
#include "stdlib/table.def"

TEST(Exports, NativeCodeOfTheBaselineAgrees) {
  if (!exports_can_run()) GTEST_SKIP() << "the machine lacks AVX2 or FMA";
  const LibraryFunction* row = library().data();
#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc)                                      \
  expect_native_agrees<Row_##symbol::Of<float>, float>(*row);                                                          \
  expect_native_agrees<Row_##symbol::Of<double>, double>(*row++);
#include "stdlib/table.def"
}

} // namespace
} // namespace moonshade
