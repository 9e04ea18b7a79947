// Values, CSV and files as the programs read and write them.
#include "tools/support/csv.h"
#include "tools/support/files.h"
#include "tools/support/values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace moonshade::tools {
namespace {

std::string printed(ValueType type, Scalar value, Precision precision = Precision::F32) {
  std::string text;
  append_scalar(text, type, value, precision);
  return text;
}

TEST(Values, PrintsAsTheContractSays) {
  EXPECT_EQ(printed(ValueType::Number, {.number = double(0.1f)}), "0.100000001");
  EXPECT_EQ(printed(ValueType::Number, {.number = 0.1}, Precision::F64), "0.10000000000000001");
  EXPECT_EQ(printed(ValueType::Number, {.number = std::copysign(NAN, -1.0)}), "nan");
  EXPECT_EQ(printed(ValueType::Number, {.number = -INFINITY}), "-inf");
  EXPECT_EQ(printed(ValueType::Number, {.number = -0.0}), "-0");
  EXPECT_EQ(printed(ValueType::Integer, {.integer = INT64_MIN}), "-9223372036854775808");
  EXPECT_EQ(printed(ValueType::Boolean, {.boolean = true}), "true");
}

TEST(Values, ReadsNumbersAndRefusesOthers) {
  EXPECT_EQ(parse_scalar(ValueType::Number, " 1.5 ")->number, 1.5);
  EXPECT_EQ(parse_scalar(ValueType::Number, "0x10")->number, 16);
  EXPECT_TRUE(std::isnan(parse_scalar(ValueType::Number, "nan")->number));
  EXPECT_EQ(parse_scalar(ValueType::Number, "-inf")->number, -INFINITY);
  EXPECT_FALSE(parse_scalar(ValueType::Number, ""));
  EXPECT_FALSE(parse_scalar(ValueType::Number, "1.5x"));
  EXPECT_FALSE(parse_scalar(ValueType::Integer, "1.5"));
  EXPECT_FALSE(parse_scalar(ValueType::Integer, "9223372036854775808"));
  EXPECT_EQ(parse_scalar(ValueType::Integer, "-9223372036854775808")->integer, INT64_MIN);
  EXPECT_TRUE(parse_scalar(ValueType::Boolean, "true")->boolean);
  EXPECT_FALSE(parse_scalar(ValueType::Boolean, "yes"));
}

TEST(Values, ReadsExactlyAsManyComponentsAsTheTypeHas) {
  EXPECT_EQ(parse_value(ValueType::Vec3, "1, 2,3")->size(), 3u);
  EXPECT_FALSE(parse_value(ValueType::Vec3, "1,2"));
  EXPECT_FALSE(parse_value(ValueType::Vec3, "1,2,3,4"));
  EXPECT_FALSE(parse_value(ValueType::Vec3, "1,2,"));
  EXPECT_FALSE(parse_value(ValueType::Number, "1,2"));
}

TEST(Values, NamesComponents) {
  EXPECT_EQ(component_name("p", ValueType::Vec3, 2), "p.z");
  EXPECT_EQ(component_name("time", ValueType::Number, 0), "time");
}

class Files : public ::testing::Test {
protected:
  Files() : folder_(std::filesystem::temp_directory_path() / ("moonshade_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Files() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  std::filesystem::path folder_;
};

TEST_F(Files, CsvTakesCarriageReturnsBlanksAndQuotes) {
  CsvReader csv(put("a.csv", "\xEF\xBB\xBF\"p.x\" , p.y\r\n\r\n 1,2\n\"a \"\"b\"\"\",\n"));
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.fields(), (std::vector<std::string>{"p.x", "p.y"}));
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.fields(), (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(csv.line(), 3u);
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.fields(), (std::vector<std::string>{"a \"b\"", ""}));
  EXPECT_FALSE(csv.next());
  EXPECT_EQ(csv.error(), "");
}

TEST_F(Files, CsvTellsWhyItCannotBeRead) {
  CsvReader csv(path("missing.csv"));
  EXPECT_FALSE(csv.next());
  EXPECT_EQ(csv.error(), "No such file or directory");
}

TEST_F(Files, TakeNoNumberOfAClosedStandardFile) {
  const auto in_child = [&] {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      close(descriptor);
    keep_standard_files_apart();
    const int file = open(path("image").c_str(), O_WRONLY | O_CREAT, 0600);
    char byte = 'x';
    const bool fail_still =
        write(STDOUT_FILENO, &byte, 1) < 0 && write(STDERR_FILENO, &byte, 1) < 0 && read(STDIN_FILENO, &byte, 1) < 0;
    _exit(file > STDERR_FILENO && fail_still ? 0 : 1);
  };
  EXPECT_EXIT(in_child(), testing::ExitedWithCode(0), "");
}

TEST_F(Files, ReadsNoMoreThanItsLimit) {
  EXPECT_EQ(read_file(put("a", std::string(1000, 'x')), 1000).error, "");
  EXPECT_EQ(read_file(path("a"), 999).error, "larger than 999 bytes");
  EXPECT_EQ(read_file("/dev/zero", 1 << 20).error, "larger than 1048576 bytes");
}

TEST_F(Files, WritesWholeOrNotAtAll) {
  EXPECT_EQ(write_file(path("out.txt"), "text"), "");
  EXPECT_EQ(read_file(path("out.txt")).text, "text");
  EXPECT_EQ(write_file(path("out.txt"), "other"), "");
  EXPECT_EQ(read_file(path("out.txt")).text, "other");
  EXPECT_NE(write_file(path("missing/out.txt"), "text"), "");
  size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_))
    ++files;
  EXPECT_EQ(files, 1u) << "a temporary file was left behind";
}

TEST_F(Files, ReadingSaysWhatIsWrong) {
  EXPECT_EQ(read_file(path("missing")).error, "No such file or directory");
  EXPECT_EQ(read_file(folder_.string()).error, "Is a directory");
}

} // namespace
} // namespace moonshade::tools
