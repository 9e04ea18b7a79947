// Images that a host supplies: what reaches it from compiled code and from stock Lua, and what comes back.
#include "runtime/frontend.h"
#include "runtime/image.h"
#include "runtime/interpret.h"
#include "runtime/shader.h"

#include <atomic>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace moonshade {
namespace {

using testing::HasSubstr;

/// Smooth functions of u and v, counted.
class Waves final : public Image {
public:
  static float value(size_t c, float u, float v, float w) {
    return std::sin(6 * u + float(c)) * std::cos(5 * v) * (1 - w);
  }
  void look_up(const ImageLookup& lookup) const override {
    points += lookup.count;
    ++calls;
    for (uint32_t i = 0; i < lookup.count; ++i)
      for (size_t c = 0; c < 4; ++c) {
        const float u = lookup.u[i], v = lookup.v[i], w = lookup.width[i];
        is_in_range = is_in_range && u >= 0 && u <= 1 && v >= 0 && v <= 1 && w >= 0 && w <= 1;
        lookup.values[c][i] = value(c, u, v, w);
        if (lookup.by_u[c] == nullptr) continue;
        lookup.by_u[c][i] = 6 * std::cos(6 * u + float(c)) * std::cos(5 * v) * (1 - w);
        lookup.by_v[c][i] = -5 * std::sin(6 * u + float(c)) * std::sin(5 * v) * (1 - w);
      }
  }
  mutable std::atomic<uint64_t> points = 0, calls = 0;
  mutable std::atomic<bool> is_in_range = true;
};

struct Host {
  std::shared_ptr<Waves> waves = std::make_shared<Waves>();
  std::vector<std::string> asked;
  ImageOpener opener = [this](const std::string& file, const std::string& from, bool raw) -> OpenedImage {
    asked.push_back(file + " in " + from + (raw ? " raw" : ""));
    if (file.ends_with("none.png")) return {nullptr, "it is not there"};
    return {waves, ""};
  };
};

/// The results of one entry of `uv` and `fw` at points around the unit square.
struct Shading {
  std::vector<double> values;
  std::string error;
};
constexpr size_t kPoints = 67;

template <class T> Shading run_as(const Shader& shader, const std::string& name) {
  const ShaderInfo& info = shader.info();
  size_t entry = 0;
  while (info.entries[entry].name != name)
    ++entry;
  std::vector<T> u, v, w;
  for (size_t i = 0; i < kPoints; ++i) {
    u.push_back(static_cast<T>(double(i) * 0.37 - 9));
    v.push_back(static_cast<T>(3 - double(i) * 0.11));
    w.push_back(static_cast<T>(double(i % 5) * 0.1));
  }
  u[3] = NAN, v[5] = INFINITY, w[7] = NAN, w[8] = -1, w[9] = INFINITY;
  std::vector<const void*> inputs = {u.data(), v.data()};
  if (info.entries[entry].inputs.size() > 1) inputs.push_back(w.data());
  size_t components = 0;
  for (const ValueType type : info.entries[entry].results)
    components += component_count(type);
  std::vector<std::vector<T>> outputs(components, std::vector<T>(kPoints));
  std::vector<void*> pointers;
  for (auto& output : outputs)
    pointers.push_back(output.data());
  shader.run(entry, {kPoints, inputs.data(), pointers.data()});
  Shading run;
  for (const auto& output : outputs)
    run.values.insert(run.values.end(), output.begin(), output.end());
  return run;
}

Shading compiled(const std::string& text, Host& host, Precision precision, unsigned width,
                 const std::string& entry = "f", std::vector<Gradient> gradients = {}) {
  CompileOptions options;
  options.precision = precision;
  options.width = width;
  options.images = host.opener;
  options.gradients = std::move(gradients);
  const Compilation compilation = compile("scene/a.lua", text, options);
  if (!compilation.program) return {{}, compilation.diagnostics};
  const Instantiation instance = compilation.program->instantiate({});
  if (!instance.shader) return {{}, instance.error};
  return precision == Precision::F32 ? run_as<float>(*instance.shader, entry) : run_as<double>(*instance.shader, entry);
}

void expect_same(const Shading& a, const Shading& b) {
  EXPECT_EQ(a.error, b.error);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (size_t i = 0; i < a.values.size(); ++i)
    EXPECT_TRUE(a.values[i] == b.values[i] || (std::isnan(a.values[i]) && std::isnan(b.values[i])))
        << i << ": " << a.values[i] << " " << b.values[i];
}

constexpr const char* kDivided = R"(
  function f(uv, fw)
    local sum = texture("a.png", uv, fw)
    if uv.x > 0 then sum = sum + texture("b.png", uv * 2) end
    return sum, texture("a.png", vec2(0.25, 0.5), { raw = true }).x
  end)";

TEST(ImageSet, GivesTheSameAtEveryWidthAndInStockLua) {
  Host host;
  const Shading wide = compiled(kDivided, host, Precision::F64, 16);
  EXPECT_THAT(host.asked,
              testing::ElementsAre("a.png in scene/a.lua", "b.png in scene/a.lua", "a.png in scene/a.lua raw"));
  ASSERT_EQ(wide.error, "");
  for (const unsigned width : {1u, 4u, 8u, 32u})
    expect_same(compiled(kDivided, host, Precision::F64, width), wide);
  const Shading floats = compiled(kDivided, host, Precision::F32, 1);
  for (const unsigned width : {4u, 8u, 16u, 32u})
    expect_same(compiled(kDivided, host, Precision::F32, width), floats);
  const CheckedShader checked("scene/a.lua", kDivided);
  const Instantiation lua = interpret(checked, {}, {.images = host.opener});
  ASSERT_TRUE(lua.shader) << lua.error;
  expect_same(run_as<double>(*lua.shader, "f"), wide);
  EXPECT_TRUE(host.waves->is_in_range);
  // Coordinates that are not finite give NaN, a width that is none counts as 0, a wide one as the whole image.
  EXPECT_TRUE(std::isnan(wide.values[3]) && std::isnan(wide.values[5]));
  EXPECT_FALSE(std::isnan(wide.values[7]) || std::isnan(wide.values[8]) || std::isnan(wide.values[9]));
}

TEST(ImageSet, AsksOnlyForLanesThatLook) {
  Host host;
  const std::string text = "function f(uv) if uv.x > 0 then return texture('a.png', uv).x end return 0.0 end";
  ASSERT_EQ(compiled(text, host, Precision::F32, 16).error, "");
  // Of 67 points 42 look (one of those to the right is no number); lanes behind the last repeat it.
  EXPECT_LE(host.waves->points, 80u - 25u);
  EXPECT_LE(host.waves->calls, 5u);
}

TEST(ImageSet, HasDerivatives) {
  Host host;
  const std::string text = "function f(uv) return texture('a.png', uv * 0.5).y end";
  const Shading run = compiled(text, host, Precision::F64, 8, "f'uv", {{"f", {"uv"}}});
  ASSERT_EQ(run.error, "");
  for (size_t i = 10; i < kPoints; ++i) {
    const double x = (double(i) * 0.37 - 9) / 2, y = (3 - double(i) * 0.11) / 2;
    const double u = x - std::floor(x), v = y - std::floor(y);
    EXPECT_NEAR(run.values[kPoints + i], 0.5 * 6 * std::cos(6 * u + 1) * std::cos(5 * v), 1e-5);
    EXPECT_NEAR(run.values[2 * kPoints + i], 0.5 * -5 * std::sin(6 * u + 1) * std::sin(5 * v), 1e-5);
  }
}

TEST(ImageSet, NamesTheImageThatCannotBeOpened) {
  Host host;
  const std::string text =
      "local file = param('file', 'a.png')\nfunction f(uv) return texture(file, uv).x + texture('none.png', uv).x end";
  EXPECT_EQ(compiled(text, host, Precision::F32, 8).error,
            "scene/a.lua:2:53: the image 'none.png' cannot be used: it is not there");
  Host blind;
  blind.opener = nullptr;
  EXPECT_THAT(compiled("function f(uv) return texture('a.png', uv).x end", blind, Precision::F32, 8).error,
              HasSubstr("scene/a.lua:1:31: the image 'a.png' cannot be used: this host opens no images"));
  CheckedShader checked("scene/a.lua", text);
  checked.check_images(host.opener);
  EXPECT_FALSE(checked.ok());
}

TEST(ImageSet, ParametersNameImages) {
  Host host;
  CompileOptions options;
  options.images = host.opener;
  const Compilation compilation =
      compile("a.lua", "local file = param('file', 'one.png')\nfunction f(uv) return texture(file, uv).x end", options);
  ASSERT_TRUE(compilation.program) << compilation.diagnostics;
  EXPECT_TRUE(compilation.program->instantiate({}).shader);
  EXPECT_THAT(compilation.program->instantiate({{"file", std::string("none.png")}}).error, HasSubstr("'none.png'"));
  EXPECT_THAT(host.asked, testing::ElementsAre("one.png in a.lua", "none.png in a.lua"));
  ASSERT_EQ(compilation.program->info().images.size(), 1u);
  EXPECT_EQ(compilation.program->info().images[0].parameter, 0u);
}

TEST(ImageSet, AreOpenBeforeTheTopLevelRuns) {
  Host host;
  const Shading run =
      compiled("local c = texture('a.png', vec2(0.5, 0.25)).x\nfunction f(uv) return c end", host, Precision::F32, 8);
  ASSERT_EQ(run.error, "");
  EXPECT_EQ(float(run.values[0]), Waves::value(0, 0.5f, 0.25f, 0));
}

} // namespace
} // namespace moonshade
