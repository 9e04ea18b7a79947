// Gradients as a host asks for them: the entry's name and results, values beside central differences in double, and the
// same bits at every width.
#include "runtime/shader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace moonshade {
namespace {

using ::testing::ElementsAre;

std::shared_ptr<const Shader> instance(const std::string& text, const CompileOptions& options) {
  const Compilation compilation = compile("test.lua", text, options);
  EXPECT_EQ(compilation.diagnostics, "");
  if (compilation.program == nullptr) return nullptr;
  return compilation.program->instantiate({}).shader;
}

size_t entry_index(const Shader& shader, const std::string& name) {
  for (size_t i = 0; i < shader.info().entries.size(); ++i)
    if (shader.info().entries[i].name == name) return i;
  ADD_FAILURE() << "no entry " << name;
  return 0;
}

/// Columns of numbers.
template <class T> using Columns = std::vector<std::vector<T>>;

template <class T> Columns<T> run(const Shader& shader, const std::string& entry, const Columns<T>& inputs) {
  const size_t index = entry_index(shader, entry), count = inputs[0].size();
  unsigned components = 0;
  for (const ValueType type : shader.info().entries[index].results)
    components += component_count(type);
  Columns<T> outputs(components, std::vector<T>(count));
  std::vector<const void*> in;
  std::vector<void*> out;
  for (const auto& column : inputs)
    in.push_back(column.data());
  for (auto& column : outputs)
    out.push_back(column.data());
  shader.run(index, {count, in.data(), out.data(), nullptr, nullptr});
  return outputs;
}

template <class T> Columns<T> random_points(size_t components, size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-3, 3);
  Columns<T> columns(components, std::vector<T>(count));
  for (auto& column : columns)
    for (T& x : column)
      x = T(uniform(random));
  return columns;
}

constexpr const char* kShader = R"(
local function wave(x) return x < 0 and sin(x * 2) or x * x end
function height(p, uv)
  local h = 0.04 * turbulence(p * 3, 4) + fbm(p.xy * 2, 3)
  local x, y, n = p.x * 0.3, p.y * 0.3, 0
  while x * x + y * y < 4 and n < 12 do
    x, y, n = x * x - y * y + p.z * 0.2, 2 * x * y + uv.x * 0.1, n + 1
  end
  if p.x > 0.5 then h = h * wave(uv.y) end
  return h + 0.1 * perlin(p * 2) + smoothstep(-1, 1, noise(uv * p.x)) * wave(p.y) + 0.01 * x ^ 2
end
function color(p) return sin(p) * length(p) end
function flat(p) return floor(p.x) end
)";

TEST(Gradients, AreEntriesWithNamesAndResultsOfTheirOwn) {
  CompileOptions options;
  options.gradients = {{"height", {"p", "P", "uv"}}, {"color", {"p"}}, {"roughness", {"p"}}};
  options.entries = {"height", "color"};
  const auto shader = instance(kShader, options);
  ASSERT_NE(shader, nullptr);
  EXPECT_EQ(gradient_name(options.gradients[0]), "height'p,P,uv");
  std::vector<std::string> names;
  for (const EntryInfo& entry : shader->info().entries)
    names.push_back(entry.name);
  EXPECT_THAT(names, ElementsAre("height", "color", "height'p,P,uv", "color'p"));
  const EntryInfo& height = shader->info().entries[2];
  EXPECT_EQ(height.inputs.size(), 2u);
  EXPECT_THAT(height.results, ElementsAre(ValueType::Number, ValueType::Vec3, ValueType::Vec2));
  EXPECT_THAT(shader->info().entries[3].results,
              ElementsAre(ValueType::Vec3, ValueType::Vec3, ValueType::Vec3, ValueType::Vec3));
}

TEST(Gradients, AreTheLimitsOfDifferences) {
  CompileOptions options;
  options.precision = Precision::F64;
  options.gradients = {{"height", {"p", "uv"}}};
  const auto shader = instance(kShader, options);
  ASSERT_NE(shader, nullptr);
  const Columns<double> points = random_points<double>(5, 500);
  const Columns<double> exact = run(*shader, "height'p,uv", points);
  EXPECT_EQ(exact[0], run(*shader, "height", points)[0]);
  unsigned compared = 0;
  for (size_t c = 0; c < 5; ++c) {
    const double h = 1e-6;
    const auto at = [&](double offset) {
      Columns<double> moved = points;
      for (double& x : moved[c])
        x += offset;
      return run(*shader, "height", moved)[0];
    };
    const auto far_below = at(-2 * h), below = at(-h), above = at(h), far_above = at(2 * h);
    for (size_t i = 0; i < points[0].size(); ++i) {
      const double narrow = (above[i] - below[i]) / (2 * h), wide = (far_above[i] - far_below[i]) / (4 * h);
      if (!(std::abs(narrow - wide) < 1e-5 * (1 + std::abs(narrow)))) continue;
      EXPECT_NEAR(exact[1 + c][i], narrow, 1e-5 * (1 + std::abs(narrow))) << "component " << c << " point " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 2000u);
}

template <class T> void expect_same_bits(Precision precision) {
  Columns<T> expected;
  for (const unsigned width : kWidths)
    for (const int level : {0, 2}) {
      CompileOptions options;
      options.precision = precision;
      options.width = width;
      options.optimization = level;
      options.gradients = {{"height", {"p", "uv"}}};
      const auto shader = instance(kShader, options);
      ASSERT_NE(shader, nullptr);
      const Columns<T> results = run(*shader, "height'p,uv", random_points<T>(5, 333));
      if (expected.empty()) expected = results;
      for (size_t c = 0; c < results.size(); ++c)
        EXPECT_EQ(std::memcmp(results[c].data(), expected[c].data(), sizeof(T) * results[c].size()), 0)
            << "component " << c << " on " << width << " lanes, -O" << level;
    }
}

TEST(Gradients, HaveTheSameBitsAtEveryWidthInFloat) { expect_same_bits<float>(Precision::F32); }
TEST(Gradients, HaveTheSameBitsAtEveryWidthInDouble) { expect_same_bits<double>(Precision::F64); }

TEST(Gradients, OfConstantsAreZero) {
  CompileOptions options;
  options.gradients = {{"flat", {"p"}}};
  const auto shader = instance(kShader, options);
  ASSERT_NE(shader, nullptr);
  EXPECT_THAT(run<float>(*shader, "flat'p", {{1.5f}, {0.0f}, {0.0f}}),
              ElementsAre(ElementsAre(1), ElementsAre(0), ElementsAre(0), ElementsAre(0)));
}

TEST(Gradients, OfNoInputThatIsDeclaredAreTheEntryItself) {
  CompileOptions options;
  options.gradients = {{"flat", {"uv"}}};
  const auto shader = instance(kShader, options);
  ASSERT_NE(shader, nullptr);
  EXPECT_EQ(shader->info().entries.back().results.size(), 1u);
  EXPECT_THAT(run<float>(*shader, "flat'uv", {{1.5f}, {0.0f}, {0.0f}}), ElementsAre(ElementsAre(1)));
}

} // namespace
} // namespace moonshade
