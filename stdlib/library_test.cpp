// The table as data.
#include "stdlib/library.h"

#include "stdlib/externals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace moonshade {
namespace {

TEST(Library, OverloadsOfANameStandTogetherAndSymbolsAreUnique) {
  std::set<std::string_view> names, symbols;
  std::string_view last;
  for (const LibraryFunction& row : library()) {
    if (row.name != last) EXPECT_TRUE(names.insert(row.name).second) << row.name << " stands in two places";
    last = row.name;
    EXPECT_TRUE(symbols.insert(row.symbol).second) << row.symbol;
  }
}

TEST(Library, RowsAreComplete) {
  for (const LibraryFunction& row : library()) {
    EXPECT_GE(row.parameter_count, 1) << row.symbol;
    EXPECT_LE(row.required_count, row.parameter_count) << row.symbol;
    EXPECT_GE(row.result_count, 1) << row.symbol;
    auto names = 1 + std::count(row.parameter_names.begin(), row.parameter_names.end(), ' ');
    EXPECT_EQ(names, row.parameter_count) << row.symbol << ": " << row.parameter_names;
    EXPECT_FALSE(row.doc.empty()) << row.symbol;
    for (unsigned i = row.required_count; i < row.parameter_count; ++i)
      EXPECT_EQ(row.parameters[i], ValueType::Number) << row.symbol << ": only numbers have defaults";
    for (unsigned i = 0; row.componentwise && i < row.parameter_count; ++i)
      EXPECT_EQ(row.parameters[i], ValueType::Number) << row.symbol << ": by component, but not of numbers";
  }
}

TEST(Library, TypesAndDefaultsComeFromTheRows) {
  auto fbm = library_overloads("fbm");
  ASSERT_EQ(fbm.size(), 4u);
  const LibraryFunction& row = fbm[2];
  EXPECT_EQ(row.symbol, "fbm_vec3");
  EXPECT_EQ(row.parameters[0], ValueType::Vec3);
  EXPECT_EQ(row.parameter_count, 5);
  EXPECT_EQ(row.required_count, 1);
  EXPECT_EQ(row.defaults[1], 6);
  EXPECT_EQ(row.defaults[3], 0.5);
  EXPECT_EQ(row.defaults[4], 0);
  EXPECT_EQ(row.results[0], ValueType::Number);
  const LibraryFunction& floor = library_overloads("math.floor")[0];
  EXPECT_EQ(floor.result_count, 2);
  EXPECT_EQ(floor.results[0], ValueType::Integer);
  EXPECT_EQ(floor.results[1], ValueType::Boolean);
  EXPECT_TRUE(library_overloads("no such function").empty());
}

TEST(Library, HasBitcodeForEveryDomain) {
  for (Precision precision : {Precision::F32, Precision::F64})
    for (unsigned width : kWidths) {
      auto bitcode = library_bitcode(precision, width);
      ASSERT_GT(bitcode.size(), 1000u);
      EXPECT_EQ(std::string(bitcode.data(), 4), "BC\xC0\xDE");
      std::string file = MS_BITCODE_FOLDER "/exports" + export_ending(precision, width) + ".bc";
      std::ifstream stream(file, std::ios::binary);
      std::string built((std::istreambuf_iterator<char>(stream)), {});
      EXPECT_TRUE(built == std::string(bitcode.data(), bitcode.size())) << file << " is not what is embedded";
    }
  EXPECT_TRUE(library_bitcode(Precision::F32, 2).empty());
}

TEST(Library, ExternalsAreTheCLibrarysFunctions) {
  for (const LibraryExternal& external : library_externals()) {
    if (std::string_view(external.name) == "moonshade_sin")
      EXPECT_EQ(reinterpret_cast<double (*)(double)>(external.address)(0.5), moonshade_sin(0.5));
    EXPECT_NE(external.address, nullptr);
    EXPECT_TRUE(std::string_view(external.name).starts_with("moonshade_"));
  }
  double x[3] = {0.25, 1, 2}, y[3];
  moonshade_exp_lanes(y, x, 3);
  EXPECT_EQ(y[2], moonshade_exp(2));
  EXPECT_EQ(moonshade_log_to_base(8, 2), 3);
}

} // namespace
} // namespace moonshade
