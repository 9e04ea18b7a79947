// Programs that are accepted, and the facts that sema states about them.
#include "compiler/sema/checked.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace moonshade::sema {
namespace {

constexpr const char* kCopper = R"(
local scale     = param("scale", 4.0, { min = 0.1, max = 40, doc = "size of the dents" })
local corrosion = param("corrosion", 0.4, { min = 0, max = 1 })

local COPPER   <const> = rgb(0.72, 0.43, 0.20)
local VERDIGRIS <const> = rgb(0.20, 0.55, 0.45)

function height(p)
  return 0.04 * turbulence(p * scale, 5)
end

function color(p, n)
  local pit = smoothstep(0.015, 0.03, height(p))
  return mix(VERDIGRIS, COPPER, mix(1, pit, corrosion))
end

function roughness(p)
  return mix(0.6, 0.15, smoothstep(0.015, 0.03, height(p)))
end
)";

/// Checks that there is no diagnostic.
#define EXPECT_ACCEPTED(checked) EXPECT_EQ((checked).text, "")

TEST(Accepted, CopperOfTheManual) {
  const Checked checked(kCopper);
  ASSERT_EQ(checked.text, "");
  const ShaderInfo& info = checked.program.info;
  ASSERT_EQ(info.entries.size(), 3u);
  EXPECT_EQ(info.entries[0].name, "height");
  EXPECT_EQ(info.entries[1].name, "color");
  ASSERT_EQ(info.entries[1].inputs.size(), 2u);
  EXPECT_EQ(info.entries[1].inputs[1].name, "n");
  EXPECT_THAT(info.entries[1].results, testing::ElementsAre(ValueType::Vec3));
  ASSERT_EQ(info.parameters.size(), 2u);
  EXPECT_EQ(info.parameters[0].name, "scale");
  EXPECT_EQ(info.parameters[0].type, ValueType::Number);
  EXPECT_EQ(info.parameters[0].min, 0.1);
  EXPECT_EQ(info.parameters[0].doc, "size of the dents");
  ASSERT_EQ(checked.program.globals.size(), 4u);
  EXPECT_EQ(checked.program.globals[0].name, "scale");
  EXPECT_EQ(checked.program.globals[0].parameter, 0u);
  EXPECT_EQ(checked.program.globals[2].parameter, ~0u);
  EXPECT_EQ(checked.program.globals[2].type, ValueType::Vec3);
  // The top level, height(vec3) shared by its callers, color, roughness.
  EXPECT_EQ(checked.program.specialisations.size(), 4u);
  EXPECT_EQ(checked.program.specialisations[0]->function, checked.program.chunk->main);
}

TEST(Accepted, IntegerAndNumberGiveANumber) {
  const Checked checked(
      "function height(p)\n  local s = 0\n  local n = 0\n  for i = 1, 5 do\n    s = s + noise(p * i)\n"
      "    n = n + i\n  end\n  return s\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("height", "s").is(ValueType::Number));
  EXPECT_TRUE(checked.local_type("height", "s").mixed);
  EXPECT_TRUE(checked.local_type("height", "n").is(ValueType::Integer));
  EXPECT_TRUE(checked.local_type("height", "i").is(ValueType::Integer));
}

TEST(Accepted, MixednessSpreadsAndEnds) {
  const Checked checked("function height(p)\n  local s = 0\n  s = s + p.x\n  local t = s * 2\n  local u = s + 0.5\n"
                        "  local v = t / 2\n  local w = math.max(s, 1)\n  local k = math.floor(s) // 2\n"
                        "  return u % 1 + v // 1 + k\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("height", "t").mixed);
  EXPECT_FALSE(checked.local_type("height", "u").mixed);
  EXPECT_FALSE(checked.local_type("height", "v").mixed);
  EXPECT_TRUE(checked.local_type("height", "w").mixed);
  EXPECT_TRUE(checked.local_type("height", "k").is(ValueType::Integer));
}

TEST(Accepted, FloatLoops) {
  const Checked checked("function height(p)\n  local s = 0.0\n  for x = 0, 1, 0.25 do s = s + x end\n"
                        "  for y = 1.0, 3 do s = s + y end\n  for z = 1, 2.5 do s = s + z end\n  return s\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("height", "x").is(ValueType::Number));
  EXPECT_TRUE(checked.local_type("height", "y").is(ValueType::Number));
  EXPECT_TRUE(checked.local_type("height", "z").is(ValueType::Integer));
}

TEST(Accepted, FunctionsAreSpecialised) {
  const Checked checked("local function double(x) return x + x end\n"
                        "function color(p) return double(p) * double(1) * double(0.5) + double(p) end");
  ASSERT_EQ(checked.text, "");
  EXPECT_EQ(checked.program.specialisations.size(), 5u);
  ASSERT_NE(checked.find("double#3"), nullptr);
}

TEST(Accepted, CapturesAreListed) {
  const Checked checked("function height(p)\n  local sum, unused = 0.0, 1\n"
                        "  local function add(x) sum = sum + x end\n"
                        "  local function twice(x) add(x) add(x) end\n  twice(p.x)\n  return sum\nend");
  ASSERT_EQ(checked.text, "");
  const Specialisation* twice = checked.find("twice");
  ASSERT_NE(twice, nullptr);
  ASSERT_EQ(twice->captures.size(), 1u);
  EXPECT_EQ(twice->captures[0]->name, "sum");
  const Specialisation* height = checked.find("height");
  EXPECT_TRUE(height->captures.empty());
  EXPECT_TRUE(
      std::ranges::any_of(height->locals, [&](const auto& local) { return local.second.slot == twice->captures[0]; }));
}

TEST(Accepted, CapturedVariablesAreInferredAcrossFunctions) {
  const Checked checked("function height(p)\n  local x = 0\n  local function set() x = p.x end\n  set()\n"
                        "  local y = x\n  return y\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("height", "y").mixed);
}

TEST(Accepted, Conditionals) {
  const Checked checked("function height(p)\n  local a = p.x > 0 and 1 or 2.5\n"
                        "  local b = p.x > 0 and 1 or p.y > 0 and 2 or 3\n"
                        "  local c = p.x > 0 and p.y > 0 or not (p.z > 0)\n"
                        "  local d = (p.x > 0 and p or vec3(0)).x\n  return a + b + (c and 1 or 0) + d\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("height", "a").mixed);
  EXPECT_TRUE(checked.local_type("height", "b").is(ValueType::Integer));
  EXPECT_TRUE(checked.local_type("height", "c").is(ValueType::Boolean));
}

TEST(Accepted, MultipleResultsAreAdjusted) {
  const Checked checked("local function two() return 1, vec2(2) end\n"
                        "local function three() return 0.5, two() end\n"
                        "function pattern(p)\n  local a, b = two()\n  local c = (two())\n  local d, e, f = three()\n"
                        "  local g, h = two(), 3.0\n  local v = vec3(two())\n  return two()\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("pattern", "b").is(ValueType::Vec2));
  EXPECT_TRUE(checked.local_type("pattern", "f").is(ValueType::Vec2));
  EXPECT_TRUE(checked.local_type("pattern", "h").is(ValueType::Number));
  EXPECT_THAT(checked.program.info.entries.at(0).results, testing::ElementsAre(ValueType::Integer, ValueType::Vec2));
}

TEST(Accepted, SwizzlesAndMethods) {
  const Checked checked("function color(p)\n  local a = p.zy\n  local b = p.bgr\n  local c = p[2]\n"
                        "  return p:normalize() * p:length() + b:mix(p, 0.5) + a.x + c\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("color", "a").is(ValueType::Vec2));
  EXPECT_TRUE(checked.local_type("color", "b").is(ValueType::Vec3));
  EXPECT_TRUE(checked.local_type("color", "c").is(ValueType::Number));
}

TEST(Accepted, MethodsMeanTheLibraryAlsoWhereItIsShadowed) {
  const Checked checked("function length(v) return 1 end\nfunction height(p) return p:length() + length(p) end");
  EXPECT_ACCEPTED(checked);
}

TEST(Accepted, GotosOutwards) {
  EXPECT_ACCEPTED(Checked("function height(p)\n  local s = 0.0\n  for i = 1, 4 do\n    for j = 1, 4 do\n"
                          "      if p.x > j then goto continue end\n      if p.y > i then goto done end\n"
                          "      s = s + 1.0\n      ::continue::\n    end\n  end\n  ::done::\n  return s\nend"));
}

TEST(Accepted, EndlessLoopsAndErrorsNeedNoReturn) {
  EXPECT_ACCEPTED(Checked("function height(p)\n  while true do\n    if p.x > 0 then return 1 end\n"
                          "    if p.y > 0 then break end\n  end\n  error('no height')\nend"));
  EXPECT_ACCEPTED(Checked("local function fail() error('x') end\n"
                          "function height(p) if p.x > 0 then return 1 else fail() end end"));
}

TEST(Accepted, AssertGivesWhatItGets) {
  EXPECT_ACCEPTED(Checked("function height(p)\n  local ok = assert(p.x > 0, 'outside')\n  assert(ok)\n"
                          "  return ok and 1 or 0\nend"));
}

TEST(Accepted, AssignedOnEveryPath) {
  EXPECT_ACCEPTED(Checked("function height(p)\n  local x\n  if p.x > 0 then x = 1 elseif p.x < 0 then x = 2 else x = 3 "
                          "end\n  local y\n  repeat y = x until y > 0\n  local z\n  local function set() z = 1 end\n"
                          "  set()\n  return x + y + z\nend"));
}

TEST(Accepted, LocalsNameFunctions) {
  EXPECT_ACCEPTED(
      Checked("local floor, s = math.floor, sin\nlocal function f(x) return x * 2 end\nlocal g <const> = f\n"
              "local h = function(x) return g(x) + s(x) end\n"
              "function height(p) return h(p.x) + floor(p.y) + (function(x) return x end)(1) end"));
}

TEST(Accepted, FunctionsMayBeDeclaredFirst) {
  EXPECT_ACCEPTED(Checked("local f, g\nfunction height(p) return f(p.x) + g(p.y) end\n"
                          "function f(x) return g(x) end\ng = sin"));
  EXPECT_ACCEPTED(Checked("function height(p)\n  local k = p.x\n  local f\n  f = function(x) return x * k end\n"
                          "  local g\n  g = f\n  return g(2)\nend"));
}

TEST(Accepted, GlobalVariablesOfTheTopLevel) {
  const Checked checked("size = 2\nsize = size * 1.5\nfunction height(p) return size * p.x end");
  ASSERT_EQ(checked.text, "");
  ASSERT_EQ(checked.program.globals.size(), 1u);
  EXPECT_EQ(checked.program.globals[0].type, ValueType::Number);
}

TEST(Accepted, OtherGlobalFunctionsAreEntriesIfAllParametersAreInputs) {
  const Checked checked("function helper(x) return x end\nfunction pattern(uv) return helper(uv) end\n"
                        "function used(p) return p end\nfunction color(p) return used(p) end");
  ASSERT_EQ(checked.text, "");
  ASSERT_EQ(checked.program.info.entries.size(), 2u);
  EXPECT_EQ(checked.program.info.entries[0].name, "pattern");
  EXPECT_EQ(checked.program.info.entries[1].name, "color");
}

TEST(Accepted, AskedEntriesAlone) {
  const Checked checked("function used(p) return p end\nfunction color(p) return used(p) end\n"
                        "function height(p) return 1 end",
                        {"used"});
  ASSERT_EQ(checked.text, "");
  ASSERT_EQ(checked.program.info.entries.size(), 1u);
  EXPECT_EQ(checked.program.info.entries[0].name, "used");
  EXPECT_EQ(checked.program.specialisations.size(), 2u);
}

TEST(Accepted, EntriesConvertIntegers) {
  const Checked checked("function height(p) return 1 end");
  ASSERT_EQ(checked.text, "");
  EXPECT_THAT(checked.program.info.entries.at(0).results, testing::ElementsAre(ValueType::Number));
  EXPECT_TRUE(checked.find("height")->results.at(0).is(ValueType::Integer));
}

TEST(Accepted, ConstantsOfTheMathLibrary) {
  const Checked checked("function height(p)\n  local a = math.maxinteger\n  local b = math.pi\n"
                        "  local c = math.type(a) == 'integer'\n  local d = #'abc'\n  return b\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("height", "a").is(ValueType::Integer));
  EXPECT_TRUE(checked.local_type("height", "b").is(ValueType::Number));
  EXPECT_TRUE(checked.local_type("height", "c").is(ValueType::Boolean));
  EXPECT_TRUE(checked.local_type("height", "d").is(ValueType::Integer));
}

TEST(Accepted, MixedComparisonsNameTheirRow) {
  const Checked checked("function height(p, frame)\n  if frame > p.x then return 1 end\n"
                        "  if p.x == frame then return 2 end\n  return 3\nend");
  ASSERT_EQ(checked.text, "");
  std::vector<std::string> rows;
  for (const auto& [id, fact] : checked.find("height")->expressions)
    if (fact.form == OperatorForm::Mixed) {
      ASSERT_NE(fact.library, nullptr);
      rows.push_back(std::string(fact.library->name) + " " + std::string(name_of(fact.library->parameters[0])));
    }
  EXPECT_THAT(rows, testing::UnorderedElementsAre("op.lt number", "op.eq integer"));
}

TEST(Accepted, OperatorsOnVectorsHaveTheRowOfNumbers) {
  const Checked checked("function color(p) local a, b = p % 1, p // vec3(1)\n  return (a + b) ^ 2.5 end");
  ASSERT_EQ(checked.text, "");
  unsigned rows = 0;
  for (const auto& [id, fact] : checked.find("color")->expressions)
    rows += fact.library != nullptr;
  EXPECT_EQ(rows, 3u);
}

TEST(Accepted, ExtremaOfAnyNumberOfArguments) {
  const Checked checked("function height(p)\n  local a, b = math.max(1, 2, 3), math.min(1, p.x)\n"
                        "  local c = math.max(p.x, p.y, p.z)\n  return math.max(a) + b + c\nend");
  ASSERT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("height", "a").is(ValueType::Integer));
  EXPECT_TRUE(checked.local_type("height", "b").mixed);
  EXPECT_FALSE(checked.local_type("height", "c").mixed);
}

TEST(Accepted, ParametersOfEveryType) {
  const Checked checked("local a = param('a', 3)\nlocal b = param('b', -2.5)\nlocal c = param('c', true)\n"
                        "local d = param('d', rgb(1, 0.5, 0), { min = 0, max = 1 })\n"
                        "local e = param('e', 'dots', { choices = { 'dots', 'lines' } })\n"
                        "local f = param('f', 2 * math.pi)\nlocal g = param('g', 1.0) * 2\n"
                        "function color(p) return d * a * b * f * g end");
  ASSERT_EQ(checked.text, "");
  const auto& parameters = checked.program.info.parameters;
  ASSERT_EQ(parameters.size(), 7u);
  EXPECT_EQ(parameters[0].type, ValueType::Integer);
  EXPECT_EQ(parameters[1].default_value, Constant(-2.5));
  EXPECT_EQ(parameters[3].type, ValueType::Vec3);
  EXPECT_EQ(parameters[4].type, std::nullopt);
  EXPECT_EQ(parameters[4].choices.size(), 2u);
  for (const GlobalSlot& slot : checked.program.globals)
    EXPECT_EQ(slot.parameter != ~0u, slot.name != "g") << slot.name;
}

TEST(Accepted, OrderThatDoesNotMatter) {
  EXPECT_ACCEPTED(Checked("function height(p)\n  local x, y = 0, 1\n"
                          "  local function next_value() x = x + 1 return x end\n  local a = y + next_value()\n"
                          "  x = next_value()\n  local b = next_value() > 0 and x or y\n  return a + b\nend"));
}

} // namespace
} // namespace moonshade::sema
