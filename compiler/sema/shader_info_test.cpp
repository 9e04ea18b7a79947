// Inputs by name, and overrides of parameters: accepted, converted, refused with a message that names the parameter.
#include "compiler/sema/shader_info.h"

#include <gtest/gtest.h>

#include <limits>

namespace moonshade {
namespace {

ParameterInfo parameter(std::optional<ValueType> type, Constant value) {
  ParameterInfo info;
  info.name = "scale";
  info.type = type;
  info.default_value = std::move(value);
  return info;
}

TEST(Inputs, HaveTheTypesOfTheManual) {
  EXPECT_EQ(input_type("p"), ValueType::Vec3);
  EXPECT_EQ(input_type("uv"), ValueType::Vec2);
  EXPECT_EQ(input_type("backface"), ValueType::Boolean);
  EXPECT_EQ(input_type("frame"), ValueType::Integer);
  EXPECT_EQ(input_type("fw"), ValueType::Number);
  EXPECT_EQ(input_type("q"), std::nullopt);
}

TEST(Overrides, AreConvertedToTheParametersType) {
  const auto number = parameter(ValueType::Number, 4.0);
  EXPECT_EQ(check_override(number, int64_t{2}).value, Constant(2.0));
  EXPECT_EQ(parse_override(number, "2").value, Constant(2.0));
  EXPECT_EQ(parse_override(number, " -1e3 ").value, Constant(-1000.0));
  EXPECT_EQ(parse_override(parameter(ValueType::Integer, int64_t{1}), "-7").value, Constant(int64_t{-7}));
  EXPECT_EQ(parse_override(parameter(ValueType::Boolean, true), "false").value, Constant(false));
  EXPECT_EQ(parse_override(parameter(std::nullopt, std::string("a")), "rock.png").value,
            Constant(std::string("rock.png")));
  EXPECT_EQ(parse_override(parameter(ValueType::Vec3, std::vector<double>{0, 0, 0}), "0.2,0.4, 1").value,
            Constant(std::vector<double>{0.2, 0.4, 1}));
}

TEST(Overrides, KnowEveryNumeralOfLuas) {
  const auto number = parameter(ValueType::Number, 4.0);
  const auto integer = parameter(ValueType::Integer, int64_t{1});
  EXPECT_EQ(parse_override(number, "0x10").value, Constant(16.0));
  EXPECT_EQ(parse_override(number, "-0x1.8p1").value, Constant(-3.0));
  EXPECT_EQ(parse_override(number, ".5").value, Constant(0.5));
  EXPECT_EQ(parse_override(number, "+5.").value, Constant(5.0));
  EXPECT_EQ(parse_override(number, "-inf").value, Constant(-std::numeric_limits<double>::infinity()));
  EXPECT_EQ(parse_override(integer, "0xff").value, Constant(int64_t{255}));
  EXPECT_EQ(parse_override(integer, "-0x10").value, Constant(int64_t{-16}));
  EXPECT_EQ(parse_override(integer, "0xffffffffffffffff").value, Constant(int64_t{-1}));
  EXPECT_EQ(parse_override(integer, "-9223372036854775808").value, Constant(std::numeric_limits<int64_t>::min()));
  EXPECT_EQ(parse_override(parameter(ValueType::Vec2, std::vector<double>{0, 0}), "0x2, 1e1").value,
            Constant(std::vector<double>{2, 10}));
  for (const char* wrong : {"0x", "1.0", "9223372036854775808", "1 2", "--1", "", "ten", "1e1"})
    EXPECT_NE(parse_override(integer, wrong).error, "") << wrong;
}

TEST(Overrides, OfAnotherTypeAreRefused) {
  EXPECT_EQ(check_override(parameter(ValueType::Number, 4.0), true).error,
            "parameter 'scale' is a number, not a boolean");
  EXPECT_EQ(check_override(parameter(ValueType::Integer, int64_t{4}), 0.5).error,
            "parameter 'scale' is an integer, not a number");
  EXPECT_EQ(check_override(parameter(ValueType::Vec2, std::vector<double>{0, 0}), std::vector<double>{1, 2, 3}).error,
            "parameter 'scale' is a vec2, not a vector of 3 components");
  EXPECT_EQ(parse_override(parameter(ValueType::Number, 4.0), "2x").error, "parameter 'scale' is a number, not '2x'");
  EXPECT_EQ(parse_override(parameter(ValueType::Boolean, true), "1").error, "parameter 'scale' is a boolean, not '1'");
  EXPECT_EQ(parse_override(parameter(ValueType::Vec3, std::vector<double>{0, 0, 0}), "1,2").error,
            "parameter 'scale' is a vec3, not '1,2'");
  EXPECT_EQ(parse_override(parameter(ValueType::Integer, int64_t{1}), "99999999999999999999").error,
            "parameter 'scale' is an integer, not '99999999999999999999'");
}

TEST(Overrides, StayInTheirRange) {
  auto ranged = parameter(ValueType::Number, 4.0);
  ranged.min = 0.1;
  ranged.max = 40;
  EXPECT_EQ(check_override(ranged, 40.0).error, "");
  EXPECT_EQ(check_override(ranged, 41.0).error, "parameter 'scale': 41 is outside 0.1..40");
  EXPECT_NE(check_override(ranged, std::numeric_limits<double>::quiet_NaN()).error, "");
  ranged.max.reset();
  EXPECT_EQ(check_override(ranged, 0.0).error, "parameter 'scale': 0 is less than 0.1");
  auto tint = parameter(ValueType::Vec3, std::vector<double>{0, 0, 0});
  tint.max = 1;
  EXPECT_EQ(parse_override(tint, "0,2,0").error, "parameter 'scale': 2 is greater than 1");
  auto chosen = parameter(std::nullopt, std::string("dots"));
  chosen.choices = {std::string("dots"), std::string("lines")};
  EXPECT_EQ(parse_override(chosen, "lines").error, "");
  EXPECT_EQ(parse_override(chosen, "rings").error, "parameter 'scale': the value is none of its choices");
}

} // namespace
} // namespace moonshade
