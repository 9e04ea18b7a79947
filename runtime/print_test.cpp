// `print`: the lines of a chosen point, the same compiled as in stock Lua; nothing of it in what run() does.
#include "runtime/frontend.h"
#include "runtime/interpret.h"
#include "runtime/print_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace moonshade {
namespace {

using ::testing::ElementsAre;

/// The lines of one point of `height(p)`.
std::vector<std::string> lines(const Shader& shader, std::vector<std::array<double, 3>> points, uint64_t point) {
  std::vector<double> doubles[3];
  std::vector<float> floats[3];
  std::vector<const void*> inputs;
  for (size_t c = 0; c < 3; ++c) {
    for (const auto& at : points) {
      doubles[c].push_back(at[c]);
      floats[c].push_back(static_cast<float>(at[c]));
    }
    inputs.push_back(shader.precision() == Precision::F32 ? static_cast<const void*>(floats[c].data())
                                                          : doubles[c].data());
  }
  std::vector<std::string> result;
  shader.print(0, {points.size(), inputs.data(), nullptr, nullptr, nullptr}, point,
               [&](std::string_view line) { result.emplace_back(line); });
  return result;
}

std::shared_ptr<const Shader> compiled(const CheckedShader& checked, Precision precision, unsigned width = 0) {
  EXPECT_TRUE(checked.ok());
  CompileOptions options;
  options.precision = precision;
  options.width = width;
  const Compilation compilation = compile(checked, options);
  return compilation.program == nullptr ? nullptr : compilation.program->instantiate({}).shader;
}

/// What both kinds of shader print, under f64.
std::vector<std::string> both(const std::string& body, std::array<double, 3> p = {1, 2.5, -3}) {
  const CheckedShader checked("test.lua", body);
  std::ostringstream text;
  print_text(checked.diagnostics(), checked.sources(), text);
  EXPECT_EQ(checked.diagnostics().error_count(), 0u) << text.str();
  if (!checked.ok()) return {};
  const std::vector<std::string> expected = lines(*interpret(checked, {}, {}).shader, {p}, 0);
  EXPECT_EQ(lines(*compiled(checked, Precision::F64, 8), {p}, 0), expected);
  return expected;
}

TEST(Print, WritesValuesAsLuaDoes) {
  EXPECT_THAT(both("function height(p) print(1, 1.0, p.y, 1e100, 0.1, -7 // 2, true, 'a\\tb', \"\") return 0 end"),
              ElementsAre("1\t1.0\t2.5\t1e+100\t0.1\t-4\ttrue\ta\tb\t"));
  EXPECT_THAT(both("function height(p) print(1/0, -1/0, 0/0, -(0/0), -0.0, 2^53, 1/3) return 0 end"),
              ElementsAre("inf\t-inf\tnan\tnan\t-0.0\t9.007199254741e+15\t0.33333333333333"));
  EXPECT_THAT(both("function height(p) print(p, p.xy, vec4(p, 0/0), rgb(1, 0, 0)) return 0 end"),
              ElementsAre("vec3(1.0, 2.5, -3.0)\tvec2(1.0, 2.5)\tvec4(1.0, 2.5, -3.0, nan)\tvec3(1.0, 0.0, 0.0)"));
  EXPECT_THAT(both("function height(p) print() print(math.maxinteger, p.x > 0, '\\1\\2') return 0 end"),
              ElementsAre("", "9223372036854775807\ttrue\t\x01\x02"));
  EXPECT_THAT(both("function height(p) print(mat3(2)) return 0 end"),
              ElementsAre("mat3(2.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0)"));
}

TEST(Print, GivesAllValuesOfTheLastCall) {
  EXPECT_THAT(both("local function two(x) return x, 'two', 2 end\n"
                   "function height(p) print(two(p.x), two(p.y)) print((two(p.x))) return 0 end"),
              ElementsAre("1.0\t2.5\ttwo\t2", "1.0"));
}

TEST(Print, FollowsThePointThroughLoopsBranchesAndCalls) {
  EXPECT_THAT(both("local k = param('k', 3)\n"
                   "local function inner(i, x) if i % 2 == 0 then print('even', i, x * k) end return x end\n"
                   "function height(p)\n"
                   "  local s = p.x\n"
                   "  for i = 1, 4 do s = inner(i, s) * 2 end\n"
                   "  if p.y > 100 then print('never') end\n"
                   "  return s\n"
                   "end"),
              ElementsAre("even\t2\t6.0", "even\t4\t24.0"));
}

TEST(Print, StopsAtAFault) {
  EXPECT_THAT(both("function height(p) print('before') assert(p.x > 5) print('behind') return 0 end"),
              ElementsAre("before"));
}

TEST(Print, RunsOnceInTheFunctionOfAGradient) {
  EXPECT_THAT(both("local function f(q) print('at', q) return q.x * q.y end\n"
                   "function height(p) local g = gradient(f, p) return g.x end"),
              ElementsAre("at\tvec3(1.0, 2.5, -3.0)"));
}

TEST(Print, IsOfTheChosenPoint) {
  const CheckedShader checked("test.lua", "function height(p) print(p.x) return p.x end");
  const auto shader = compiled(checked, Precision::F32, 16);
  EXPECT_TRUE(shader->has_prints());
  EXPECT_THAT(lines(*shader, {{1, 0, 0}, {0.1, 0, 0}, {3, 0, 0}}, 1), ElementsAre("0.10000000149012"));
  EXPECT_THAT(lines(*shader, {{1, 0, 0}, {0.1, 0, 0}, {3, 0, 0}}, 2), ElementsAre("3.0"));
  const CheckedShader silent("test.lua", "function height(p) return p.x end");
  EXPECT_FALSE(compiled(silent, Precision::F32)->has_prints());
  EXPECT_TRUE(lines(*compiled(silent, Precision::F32), {{1, 0, 0}}, 0).empty());
}

/// The code that run() executes is that of the same shader without its prints.
TEST(Print, LeavesNothingInTheCodeThatShades) {
  const auto assembly = [](const std::string& print) {
    const CheckedShader checked("test.lua",
                                "function height(p)\n  local s = 0.0\n  for i = 1, 5 do\n    s = s + noise(p * i)\n" +
                                    print + "  end\n  return s\nend\n");
    EXPECT_TRUE(checked.ok());
    return emit(checked, Stage::Assembly, {}).bytes;
  };
  EXPECT_EQ(assembly("    print(i, s, sin(s))\n"), assembly(""));
}

TEST(Print, TextOfNumbers) {
  EXPECT_EQ(lua_number_text(3), "3.0");
  EXPECT_EQ(lua_number_text(1e15), "1e+15");
  EXPECT_EQ(lua_number_text(-std::numeric_limits<double>::quiet_NaN()), "nan");
  const uint64_t components[] = {std::bit_cast<uint64_t>(0.5), std::bit_cast<uint64_t>(-2.0)};
  EXPECT_EQ(value_text(ValueType::Vec2, components), "vec2(0.5, -2.0)");
}

} // namespace
} // namespace moonshade
