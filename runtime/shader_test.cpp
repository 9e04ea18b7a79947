// Compiled shaders from source, as a host uses them: parameters, faults, options, emission, threads.
#include "runtime/shader.h"

#include "runtime/frontend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <thread>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace moonshade {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<const Program> compiled(const std::string& text, const CompileOptions& options = {}) {
  const Compilation compilation = compile("test.lua", text, options);
  EXPECT_EQ(compilation.diagnostics, "");
  return compilation.program;
}

std::shared_ptr<const Shader> instance(const std::string& text, const CompileOptions& options = {},
                                       const std::map<std::string, Constant>& parameters = {}) {
  const auto program = compiled(text, options);
  if (program == nullptr) return nullptr;
  const Instantiation instantiation = program->instantiate(parameters);
  EXPECT_EQ(instantiation.error, "");
  return instantiation.shader;
}

/// Runs entry 0, of one point `p` on the diagonal for each value and one number as result, under f32.
std::vector<float> shade(const Shader& shader, const std::vector<float>& p, FaultReport* faults = nullptr) {
  std::vector<float> result(p.size(), -1);
  const void* inputs[] = {p.data(), p.data(), p.data()};
  void* outputs[] = {result.data()};
  shader.run(0, {p.size(), inputs, outputs, faults, nullptr});
  return result;
}

TEST(CompiledShader, TakesParametersWithoutCompilingAgain) {
  const auto program = compiled(R"(
    local scale = param("scale", 2.0, { min = 0, max = 10 })
    local count = param("count", 3)
    local on = param("on", true)
    local tint = param("tint", rgb(0.25, 0.5, 1))
    local doubled = scale * 2
    function roughness(p)
      if on then return p.x * doubled + count + tint.y end
      return 0
    end)");
  ASSERT_NE(program, nullptr);
  const auto value = [&](const std::map<std::string, Constant>& parameters) {
    return shade(*program->instantiate(parameters).shader, {1}).at(0);
  };
  EXPECT_EQ(value({}), 1 * 4 + 3 + 0.5f);
  EXPECT_EQ(value({{"scale", 3.0}}), 6 + 3 + 0.5f);
  EXPECT_EQ(value({{"scale", int64_t{3}}}), 6 + 3 + 0.5f);
  EXPECT_EQ(value({{"count", int64_t{10}}}), 4 + 10 + 0.5f);
  EXPECT_EQ(value({{"on", false}}), 0);
  EXPECT_EQ(value({{"tint", std::vector<double>{1, 2, 3}}}), 4 + 3 + 2.0f);
}

TEST(CompiledShader, RunsCodeForALesserProcessorAndRefusesWhatCannotRun) {
  const std::string text = "function height(p) return perlin(p * 3.7) + noise(p) + worley(p) end";
  CompileOptions options;
  std::vector<float> points;
  for (int i = 0; i < 200; ++i)
    points.push_back(static_cast<float>(i) * 0.173F - 17);
  const std::vector<float> native = shade(*instance(text, options), points);
#if defined(__x86_64__)
  options.cpu = "x86-64-v2";
  EXPECT_EQ(shade(*instance(text, options), points), native);
  if (__builtin_cpu_supports("avx2") != 0) {
    options.cpu = "haswell";
    EXPECT_EQ(shade(*instance(text, options), points), native);
  }
  options.target = "aarch64-linux-gnu";
  options.cpu = "generic";
#else
  options.target = "x86_64-linux-gnu";
  options.cpu = "x86-64";
#endif
  EXPECT_THAT(compile("test.lua", text, options).diagnostics, HasSubstr("does not run on this machine"));
}

TEST(CompiledShader, ChoosesTheWidthByTheLengthOfTheCode) {
  const unsigned native = native_width(Precision::F32);
  if (native < 8) GTEST_SKIP() << "one register a value everywhere";
  EXPECT_EQ(compiled("function height(p) return noise(p) end")->width(), 2 * native);
  EXPECT_EQ(compiled("function height(p) return noise(p) + perlin(p) + worley(p) + fbm(p) + gabor(p) end")->width(),
            native);
}

TEST(CompiledShader, RefusesParametersByName) {
  const auto program = compiled(R"(
    local scale = param("scale", 2.0, { min = 0, max = 10 })
    function roughness(p) return p.x * scale end)");
  ASSERT_NE(program, nullptr);
  for (const auto& [name, value] : std::map<std::string, Constant>{{"scale", 11.0}, {"scael", 1.0}}) {
    const Instantiation instantiation = program->instantiate({{name, value}});
    EXPECT_EQ(instantiation.shader, nullptr);
    EXPECT_THAT(instantiation.error, HasSubstr(name));
  }
  EXPECT_THAT(program->instantiate({{"scale", true}}).error, HasSubstr("scale"));
}

TEST(CompiledShader, ReportsDiagnosticsInsteadOfAProgram) {
  const Compilation compilation = compile("bad.lua", "function color(p)\n  return q\nend\n", {});
  EXPECT_EQ(compilation.program, nullptr);
  EXPECT_THAT(compilation.diagnostics, HasSubstr("bad.lua:2:10: error: "));
}

TEST(CompiledShader, RefusesWhatIsTooLarge) {
  std::string text = "function roughness(p)\n  local x = p.x\n";
  for (int i = 0; i < 60'000; ++i)
    text += "  x = x * p.y + p.z * 0.5 - x * x * p.z\n";
  const Compilation compilation = compile("large.lua", text + "  return x\nend\n", {});
  EXPECT_EQ(compilation.program, nullptr);
  EXPECT_TRUE(compilation.is_too_large);
  EXPECT_THAT(compilation.diagnostics, HasSubstr("large.lua:"));
  EXPECT_THAT(compilation.diagnostics, HasSubstr("operations (limit "));
  EXPECT_THAT(compilation.diagnostics, HasSubstr("too-large"));
}

TEST(CompiledShader, RefusesWhatTakesTooMuchStack) {
  // many values that live together, and a function so long that its registers are allocated the quick way
  std::string text = "function roughness(p)\n  local x = p.x\n";
  for (int block = 0; block < 200; ++block) {
    text += "  do\n";
    for (int i = 0; i < 100; ++i)
      text += "    local v" + std::to_string(i) + " = sin(x + " + std::to_string(i) + ")\n";
    for (int i = 0; i < 100; ++i)
      text += "    x = x + v" + std::to_string(i) + " * x\n";
    text += "  end\n";
  }
  CompileOptions options;
  options.width = 32;
  options.optimization = 0;
  const Compilation compilation = compile("deep.lua", text + "  return x\nend\n", options);
  EXPECT_EQ(compilation.program, nullptr);
  EXPECT_THAT(compilation.diagnostics, HasSubstr("bytes of stack (limit "));
}

TEST(CompiledShader, SaysWhereTheFirstPointFaulted) {
  CompileOptions options;
  options.width = 8;
  const auto shader = instance("function roughness(p)\n  assert(p.x < 5, 'too far')\n  return p.x\nend\n", options);
  ASSERT_NE(shader, nullptr);
  std::vector<float> p(29, 1);
  p[13] = p[28] = 7;
  FaultReport faults;
  const std::vector<float> result = shade(*shader, p, &faults);
  EXPECT_EQ(faults.count, 2u);
  EXPECT_EQ(faults.first_point, 13u);
  EXPECT_EQ(faults.first_code, FaultCode::Assert);
  const FaultSite site = shader->fault_site(faults.first_site);
  EXPECT_EQ(site.file, "test.lua");
  EXPECT_EQ(site.line, 2u);
  EXPECT_EQ(site.message, "too far");
  EXPECT_EQ(result[13], 0);
  EXPECT_EQ(result[28], 0);
  EXPECT_EQ(result[27], 1);
}

TEST(CompiledShader, ReportsFaultsOfTheTopLevelAsErrors) {
  const auto program = compiled(R"(
local n = param("n", 4)
local q = 100 // n
function roughness(p) return p.x * q end)");
  ASSERT_NE(program, nullptr);
  EXPECT_EQ(shade(*program->instantiate({}).shader, {2}).at(0), 50);
  const Instantiation instantiation = program->instantiate({{"n", int64_t{0}}});
  EXPECT_EQ(instantiation.shader, nullptr);
  EXPECT_THAT(instantiation.error, HasSubstr("test.lua:3:"));
  EXPECT_THAT(instantiation.error, HasSubstr("division"));
}

TEST(CompiledShader, KeepsToTheStepLimit) {
  CompileOptions options;
  options.step_limit = 1000;
  const auto shader =
      instance("function roughness(p)\n  local x = p.x\n  while x > 0 do x = x - 1 end\n  return x\nend", options);
  ASSERT_NE(shader, nullptr);
  FaultReport faults;
  const std::vector<float> result = shade(*shader, {5, 1e9F, 998, 1.5F}, &faults);
  EXPECT_EQ(faults.count, 1u);
  EXPECT_EQ(faults.first_point, 1u);
  EXPECT_EQ(faults.first_code, FaultCode::StepLimit);
  EXPECT_THAT(result, ::testing::ElementsAre(0, 0, 0, -0.5F));
}

TEST(CompiledShader, HasOnlyTheEntriesThatWereAskedFor) {
  CompileOptions options;
  options.entries = {"height"};
  const auto shader = instance("function color(p) return p end\nfunction height(p) return p.x + 1 end", options);
  ASSERT_NE(shader, nullptr);
  ASSERT_EQ(shader->info().entries.size(), 1u);
  EXPECT_EQ(shader->info().entries[0].name, "height");
  EXPECT_EQ(shade(*shader, {2}).at(0), 3);
}

TEST(CompiledShader, TakesUniformInputsOnce) {
  CompileOptions options;
  options.uniform_inputs = {"time"};
  const auto shader = instance("function roughness(p, time) return p.x + sin(time) end", options);
  ASSERT_NE(shader, nullptr);
  const std::vector<float> p(37, 2);
  std::vector<float> result(p.size());
  const float time = 0.5F;
  const void* inputs[] = {p.data(), p.data(), p.data(), &time};
  void* outputs[] = {result.data()};
  shader->run(0, {p.size(), inputs, outputs, nullptr, nullptr});
  for (const float value : result)
    EXPECT_NEAR(value, 2 + std::sin(0.5), 1e-6);
}

TEST(CompiledShader, ConvertsIntegersToTheResultsOfEntries) {
  const auto shader = instance("function roughness(p) return 3 end");
  ASSERT_NE(shader, nullptr);
  EXPECT_THAT(shade(*shader, {1, 2}), ::testing::ElementsAre(3, 3));
}

#if defined(__x86_64__)
TEST(CompiledShader, KeepsDenormalsAndRoundingWhateverTheHostHasSet) {
  const auto shader = instance("function roughness(p) return p.x * 0.5 + p.y / 3 end");
  ASSERT_NE(shader, nullptr);
  const std::vector<float> p = {std::numeric_limits<float>::denorm_min() * 64, 1, 0.1F, 7};
  const std::vector<float> expected = shade(*shader, p);
  EXPECT_NE(expected[0], 0);
  const unsigned saved = _mm_getcsr();
  _mm_setcsr(saved | 0x8040); // flush to zero, denormals are zero
  std::fesetround(FE_UPWARD);
  const std::vector<float> result = shade(*shader, p);
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  const bool restored = (_mm_getcsr() & 0x8040) == 0x8040;
  std::fesetround(FE_TONEAREST);
  _mm_setcsr(saved);
  EXPECT_TRUE(restored);
  EXPECT_EQ(result, expected);
}
#endif

TEST(CompiledShader, CompilesAndRunsOnManyThreads) {
  const std::string text = R"(
    local scale = param("scale", 2.0)
    function roughness(p)
      local sum = 0.0
      for i = 1, 5 do
        if noise(p * scale * i) < 0 then break end
        sum = sum + 1 / i
      end
      return sum
    end)";
  const auto shared = instance(text);
  ASSERT_NE(shared, nullptr);
  std::vector<float> p;
  for (int i = 0; i < 1003; ++i)
    p.push_back(static_cast<float>(i) * 0.037F);
  const std::vector<float> expected = shade(*shared, p);
  std::vector<std::thread> threads;
  std::vector<std::vector<float>> results(8);
  for (size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      CompileOptions options;
      options.width = kWidths[t + 1];
      const Compilation own = compile("test.lua", text, options);
      results[t] = shade(*own.program->instantiate({}).shader, p);
      for (int i = 0; i < 50; ++i)
        results[t + 4] = shade(*shared, p);
    });
  for (std::thread& thread : threads)
    thread.join();
  for (const std::vector<float>& result : results)
    EXPECT_EQ(result, expected);
}

TEST(Emission, GivesEveryStage) {
  const CheckedShader shader("test.lua", "function height(p) return p.x * 2 + noise(p) end");
  ASSERT_TRUE(shader.ok());
  const CompileOptions options;
  EXPECT_THAT(emit(shader, Stage::Ast, options).bytes, HasSubstr("height"));
  EXPECT_THAT(emit(shader, Stage::Ir, options).bytes, HasSubstr("entry height"));
  EXPECT_THAT(emit(shader, Stage::Llvm, options).bytes, HasSubstr("define void @moonshade_entry_height"));
  EXPECT_THAT(emit(shader, Stage::Assembly, options).bytes, HasSubstr("moonshade_entry_height:"));
  EXPECT_EQ(emit(shader, Stage::Object, options).bytes.substr(0, 4), "\x7f"
                                                                     "ELF");
}

TEST(Emission, IsForOtherMachinesToo) {
  const CheckedShader shader("test.lua", "function height(p) return p.x * 2 + noise(p) end");
  CompileOptions options;
  options.target = "aarch64-linux-gnu";
  Emission emission = emit(shader, Stage::Assembly, options);
  EXPECT_EQ(emission.error, "");
  EXPECT_THAT(emission.bytes, HasSubstr(".4s"));
  options = {};
  options.cpu = "x86-64-v3";
  EXPECT_THAT(emit(shader, Stage::Assembly, options).bytes, HasSubstr("ymm"));
  options.cpu = "x86-64-v2";
  EXPECT_THAT(emit(shader, Stage::Assembly, options).bytes, ::testing::Not(HasSubstr("ymm")));
}

TEST(Emission, NamesAnUnknownMachine) {
  const CheckedShader shader("test.lua", "function height(p) return p.x end");
  CompileOptions options;
  options.cpu = "pentium99";
  EXPECT_THAT(emit(shader, Stage::Assembly, options).error, HasSubstr("pentium99"));
  EXPECT_THAT(compile(shader, options).diagnostics, HasSubstr("pentium99"));
  options = {};
  options.target = "z80-unknown-cpm";
  EXPECT_THAT(emit(shader, Stage::Object, options).error, HasSubstr("z80"));
}

} // namespace
} // namespace moonshade
