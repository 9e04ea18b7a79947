// The stock-Lua oracle: values, faults, the sandbox, steps, parameters, threads.
#include "runtime/interpret.h"

#include "compiler/base/arena.h"
#include "compiler/syntax/parser.h"
#include "runtime/interpret_steps.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

namespace moonshade {
namespace {

// ---- steps ---------------------------------------------------------------------------------------------------------

std::string counted(const std::string& text, CountedSteps steps = CountedSteps::All) {
  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  const FileId file = sources.add("test.lua", text);
  const syntax::Chunk* chunk = syntax::parse(sources, file, arena, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << text;
  return with_counted_steps(*chunk, text, steps);
}

TEST(CountedSteps, StandAtTheBeginningOfBodies) {
  EXPECT_EQ(counted("for k = 1, 2 do f() end"), "for k = 1, 2 do (\"\")();f() end");
  EXPECT_EQ(counted("while x do x = g() end"), "while x do (\"\")();x = g() end");
  EXPECT_EQ(counted("repeat x = 1 until x"), "repeat(\"\")(); x = 1 until x");
  EXPECT_EQ(counted("function f(a) return a end"), "function f(a) (\"\")();return a end");
  EXPECT_EQ(counted("local f = function() end"), "local f = function() (\"\")();end");
  EXPECT_EQ(counted("for k = 1, 2 do end"), "for k = 1, 2 do (\"\")();end");
  EXPECT_EQ(counted("while x do::l::end"), "while x do(\"\")();::l::end");
  EXPECT_EQ(counted("repeat until x"), "repeat(\"\")(); until x");
}

TEST(CountedSteps, ReachFunctionsAndLoopsInsideOthers) {
  EXPECT_EQ(counted("if a then repeat local f = function() while b do end end until c end"),
            "if a then repeat(\"\")(); local f = function() (\"\")();while b do (\"\")();end end until c end");
}

TEST(CountedSteps, LeaveCallsOutWhereOnlyLoopsCount) {
  EXPECT_EQ(counted("local f = function() while b do end end", CountedSteps::Loops),
            "local f = function() while b do (\"\")();end end");
}

TEST(CountedSteps, LeaveStringsCommentsAndLinesAlone) {
  const std::string text = "local s = 'while true do end' -- function() end\nlocal t = [[\nrepeat until x]]\n";
  EXPECT_EQ(counted(text), text);
}

// ---- shaders -------------------------------------------------------------------------------------------------------

/// Shades one point; inputs by component.
struct Point {
  std::vector<double> results;
  FaultReport report;
  FaultSite site;
};

Point shade(const Shader& shader, const std::vector<double>& inputs, size_t entry = 0) {
  const EntryInfo& info = shader.info().entries[entry];
  std::vector<const void*> input_pointers;
  for (const double& input : inputs)
    input_pointers.push_back(&input);
  Point point;
  for (ValueType type : info.results)
    point.results.resize(point.results.size() + component_count(type), -99);
  std::vector<void*> output_pointers;
  for (double& result : point.results)
    output_pointers.push_back(&result);
  Batch batch;
  batch.count = 1;
  batch.inputs = input_pointers.data();
  batch.outputs = output_pointers.data();
  batch.faults = &point.report;
  shader.run(entry, batch);
  if (point.report.count != 0) point.site = shader.fault_site(point.report.first_site);
  return point;
}

Instantiation interpreted(const std::string& text, const std::map<std::string, Constant>& parameters = {},
                          const InterpretOptions& options = {}) {
  const CheckedShader checked("test.lua", text);
  std::string messages;
  for (const Diagnostic* diagnostic : checked.diagnostics().sorted())
    messages += diagnostic->message + "\n";
  EXPECT_TRUE(checked.ok()) << messages;
  if (!checked.ok()) return {};
  return interpret(checked, parameters, options);
}

TEST(Interpret, GivesTheValuesOfStockLua) {
  const auto instance = interpreted("function color(p, time) return p * time + 0.5 end");
  ASSERT_TRUE(instance.shader) << instance.error;
  EXPECT_EQ(instance.shader->precision(), Precision::F64);
  EXPECT_EQ(shade(*instance.shader, {1, 2, 3, 2}).results, (std::vector<double>{2.5, 4.5, 6.5}));
}

TEST(Interpret, ConvertsAnIntegerToTheDeclaredNumber) {
  const auto instance = interpreted("function height(p) return 3 end");
  ASSERT_TRUE(instance.shader) << instance.error;
  EXPECT_EQ(shade(*instance.shader, {0, 0, 0}).results, std::vector<double>{3});
}

TEST(Interpret, TellsFaultsWithTheirPlaces) {
  const auto instance = interpreted("function height(p)\n  local x = math.floor(p.x)\n  if x == 1 then\n"
                                    "    assert(false, 'one')\n  elseif x == 2 then\n    error('two')\n  end\n"
                                    "  for k = 1, 2, x do break end\n  return 7 // (x - 3) + 7 % (x - 4)\nend");
  ASSERT_TRUE(instance.shader) << instance.error;
  const auto expect = [&](double x, FaultCode code, uint32_t line, const std::string& message) {
    const Point point = shade(*instance.shader, {x, 0, 0});
    EXPECT_EQ(point.report.count, 1u) << x;
    EXPECT_EQ(point.report.first_code, code) << x;
    EXPECT_EQ(point.site.line, line) << x;
    EXPECT_EQ(point.site.message, message) << x;
    EXPECT_EQ(point.results, std::vector<double>{0}) << x;
  };
  expect(1, FaultCode::Assert, 4, "one");
  expect(2, FaultCode::Error, 6, "two");
  expect(0, FaultCode::ForStepZero, 8, "");
  expect(3, FaultCode::DivideByZero, 9, "");
  expect(4, FaultCode::DivideByZero, 9, "");
  expect(1e300, FaultCode::IntegerRange, 2, "");
  expect(NAN, FaultCode::IntegerRange, 2, "");
  EXPECT_EQ(shade(*instance.shader, {5, 0, 0}).report.count, 0u);
  EXPECT_EQ(shade(*instance.shader, {2, 0, 0}).site.column, 5u);
}

TEST(Interpret, CountsStepsExactly) {
  const std::string text = "local function f(x) return x end\n"
                           "function height(time) local k = 0 while k < time do k = f(k) + 1 end return k end";
  const auto instance = interpreted(text, {}, {.count_steps = true, .step_limit = 11});
  ASSERT_TRUE(instance.shader) << instance.error;
  EXPECT_EQ(shade(*instance.shader, {5}).results, std::vector<double>{5}); // 1 entry, 5 turns, 5 calls
  EXPECT_EQ(shade(*instance.shader, {6}).report.first_code, FaultCode::StepLimit);
  EXPECT_EQ(shade(*instance.shader, {5}).report.count, 0u) << "each point has the limit for itself";
}

TEST(Interpret, EndsEndlessLoopsWithoutCountingToo) {
  const auto instance = interpreted("function height(time) while time == time do end return time end", {},
                                    {.count_steps = false, .step_limit = 1000});
  ASSERT_TRUE(instance.shader) << instance.error;
  EXPECT_EQ(shade(*instance.shader, {1}).report.first_code, FaultCode::StepLimit);
  EXPECT_EQ(shade(*instance.shader, {NAN}).report.count, 0u);
}

TEST(Interpret, SetsParameters) {
  const std::string text =
      "local s = param('scale', 2.0, { min = 0, max = 10 })\nfunction height(time) return s * time end";
  EXPECT_EQ(shade(*interpreted(text).shader, {3}).results[0], 6);
  EXPECT_EQ(shade(*interpreted(text, {{"scale", 5.0}}).shader, {3}).results[0], 15);
  EXPECT_NE(interpreted(text, {{"scale", 11.0}}).error.find("scale"), std::string::npos);
  EXPECT_NE(interpreted(text, {{"sclae", 1.0}}).error.find("sclae"), std::string::npos);
}

TEST(Interpret, TellsFaultsOfTheTopLevel) {
  const auto instance =
      interpreted("local n = param('n', 1)\nlocal x = 1 // n\nfunction height(p) return x end", {{"n", int64_t{0}}});
  EXPECT_FALSE(instance.shader);
  EXPECT_EQ(instance.error, "test.lua:2:13: the top level faults: division");
}

TEST(Interpret, SaysWhereLuaHasNoCapacity) {
  std::string text = "function height(p)\n";
  for (int k = 0; k < 240; ++k)
    text += "local v" + std::to_string(k) + " = p.x\n";
  const CheckedShader checked("test.lua", text + "return v0\nend");
  if (!checked.ok()) GTEST_SKIP() << "the parser's own limit is as small";
  const Instantiation instance = interpret(checked, {}, {});
  EXPECT_FALSE(instance.shader);
  EXPECT_NE(instance.error.find("stock Lua cannot load this file"), std::string::npos) << instance.error;
  EXPECT_NE(instance.error.find("too many local variables"), std::string::npos) << instance.error;
}

TEST(Interpret, TakesAFirstLineThatIsNoLua) {
  const auto instance = interpreted("#!/usr/bin/lua\nfunction height(p) return 1 // math.floor(p.x) end");
  ASSERT_TRUE(instance.shader) << instance.error;
  EXPECT_EQ(shade(*instance.shader, {0, 0, 0}).site.line, 2u);
}

TEST(Interpret, ServesManyThreads) {
  const auto instance = interpreted("function height(p) return noise(p) + p.x end");
  ASSERT_TRUE(instance.shader) << instance.error;
  const double expected = shade(*instance.shader, {0.3, 0.4, 0.5}).results[0];
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int k = 0; k < 200; ++k)
        wrong += shade(*instance.shader, {0.3, 0.4, 0.5}).results[0] != expected;
    });
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(wrong, 0);
}

} // namespace
} // namespace moonshade
