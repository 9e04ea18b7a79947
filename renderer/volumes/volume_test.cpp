// Hypertextures against closed forms: what passes, what is scattered once and for ever, what glows.
#include "renderer/sampling/warp.h"
#include "renderer/test_support.h"

#include <gtest/gtest.h>

namespace moonshade::renderer {
namespace {

using testing::CppShader;
using testing::FixedShaders;
using testing::TemporaryFolder;

/// The mean of a small picture; controls are multiplied before.
Vec3 mean_of(const std::string& scene, std::shared_ptr<const Shader> shader = nullptr, float controls = 1) {
  TemporaryFolder folder;
  folder.write("fake.lua", "-- a shader in C++ stands in\n");
  Folders folders = folder.folders();
  SceneReading reading = parse_lua_scene(folder / "scene.lua", scene, folders);
  EXPECT_EQ(reading.error, "");
  if (!reading.scene) return Vec3(-1);
  FixedShaders shaders(std::move(shader));
  Preparation preparation = prepare(std::move(*reading.scene), shaders);
  EXPECT_EQ(preparation.error, "");
  if (!preparation.prepared) return Vec3(-1);
  preparation.prepared->volumes->multiply_controls(controls);
  RenderProgress progress;
  RenderResult result = render(*preparation.prepared, {}, progress);
  EXPECT_EQ(result.fault_count, 0u);
  DVec3 sum(0);
  for (const Vec3& p : result.picture.pixels)
    sum += DVec3(p);
  return Vec3(sum / double(result.picture.pixels.size()));
}

std::string settings(int samples, int depth) {
  return "render{ width = 16, height = 16, samples = " + std::to_string(samples) +
         ", depth = " + std::to_string(depth) + " } ";
}

/// Straight through the middle of what stands at the origin, along x, to a sky of radiance 1.
const std::string kThrough = "camera{ from = {-3, 0, 0}, to = {0, 0, 0}, fov = 0.01 } light{ type = 'sky' } ";

std::shared_ptr<CppShader> density(std::function<double(const double* p)> function) {
  auto s = std::make_shared<CppShader>();
  s->add("density", {{"p", ValueType::Vec3}}, ValueType::Number,
         [function](const double* in, double* out) { return out[0] = function(in), FaultCode::None; });
  return s;
}

TEST(Volumes, LetThroughWhatBeerAndLambertSay) {
  for (float sigma : {0.5f, 2.0f, 5.0f}) {
    std::string volume = "material{ color = 0, density = " + std::to_string(sigma) + " } }";
    float expected = std::exp(-sigma);
    EXPECT_NEAR(mean_of(kThrough + settings(256, 8) + "box{ material = " + volume).x, expected, 0.01f) << sigma;
    EXPECT_NEAR(mean_of(kThrough + settings(256, 8) + "sphere{ radius = 0.5, material = " + volume).x, expected, 0.01f);
    // Density is per unit of p: what is stretched is as thick as before.
    EXPECT_NEAR(mean_of(kThrough + settings(256, 8) + "box{ scale = {2, 1, 3}, material = " + volume).x, expected,
                0.01f);
    // From within, half of the way.
    std::string inside = kThrough;
    inside.replace(inside.find("{-3, 0, 0}"), 10, "{0, 0, 0}")
        .replace(inside.find("to = {0, 0, 0}"), 14, "to = {1, 0, 0}");
    EXPECT_NEAR(mean_of(inside + settings(256, 8) + "box{ material = " + volume).x, std::exp(-sigma / 2), 0.015f);
  }
}

TEST(Volumes, AreUnbiasedForAnyControl) {
  // Density 4 (x + 1/2) along the way: exp(-2). Controls below it give weights, above it idle collisions.
  auto ramp = density([](const double* p) { return 4 * (p[0] + 0.5); });
  std::string box = "box{ material = material{ color = 0, shader = 'fake.lua' } }";
  for (float controls : {0.4f, 1.0f, 3.0f})
    EXPECT_NEAR(mean_of(kThrough + settings(2048, 8) + box, ramp, controls).x, std::exp(-2.0f), 0.01f) << controls;
  // The same towards a light, by ratio tracking.
  std::string lit =
      "camera{ from = {0.8, -0.8, 0}, to = {0, -1, 0}, fov = 0.01 } plane{ point = {0, -1, 0}, material = "
      "material{ name = 'floor', color = 0.5, ior = 1 } } light{ type = 'point', position = {0, 3, 0}, "
      "color = 10 } box{ rotate = {0, 0, 90}, material = material{ color = 0, shader = 'fake.lua' } } ";
  float expected = 0.5f / kPi * 10 / 16 * std::exp(-2.0f);
  for (float controls : {0.4f, 1.0f, 3.0f})
    EXPECT_NEAR(mean_of(lit + settings(2048, 2), ramp, controls).x, expected, 0.04f * expected) << controls;
}

TEST(Volumes, LoseNothingWhereTheyAreWhite) {
  for (const char* material : {"density = 3", "density = 3, anisotropy = 0.8", "density = 1, anisotropy = -0.5"})
    EXPECT_NEAR(mean_of(kThrough + settings(256, 512) + "sphere{ radius = 0.7, material = material{ color = 1, " +
                        material + " } }")
                    .x,
                1, 0.01f)
        << material;
}

TEST(Volumes, ScatterOnceAsIntegralsSay) {
  // The sun from above on a cube of density s, seen from the side through its middle: on the way in each light has
  // passed half of the cube: a p E exp(-s / 2) (1 - exp(-s)).
  for (float g : {0.0f, 0.6f}) {
    float s = 1.5f, albedo = 0.7f, phase = phase_hg(0, g);
    float expected = albedo * phase * 3 * std::exp(-s / 2) * (1 - std::exp(-s));
    Vec3 value = mean_of("camera{ from = {-3, 0, 0}, to = {0, 0, 0}, fov = 0.01 } light{ type = 'sun', direction = {0, "
                         "1, 0}, angle = 0, color = 3 } box{ material = material{ color = 0.7, density = 1.5, "
                         "anisotropy = " +
                         std::to_string(g) + " } } " + settings(512, 2));
    EXPECT_NEAR(value.x, expected, 0.02f * expected) << g;
  }
}

TEST(Volumes, GlowAsLongAsTheyAre) {
  std::string dark = "camera{ from = {-3, 0, 0}, to = {0, 0, 0}, fov = 0.01 } light{ type = 'sky', intensity = 0 } ";
  auto glow = [&](const char* density) {
    return mean_of(dark + settings(512, 8) +
                   "box{ material = material{ color = 0, emission = {1, 2, 0}, density = " + density + " } }");
  };
  EXPECT_NEAR(glow("0").y, 2, 0.04f);
  EXPECT_NEAR(glow("2").y, 2 * (1 - std::exp(-2.0f)) / 2, 0.02f);
  EXPECT_EQ(glow("2").z, 0);
}

TEST(Volumes, NegativeDensitiesCountAsNone) {
  auto negative = density([](const double*) { return -3.0; });
  EXPECT_EQ(mean_of(kThrough + settings(16, 8) + "box{ material = material{ shader = 'fake.lua' } }", negative),
            Vec3(1));
}

TEST(Volumes, FaultsEndPathsInTheDark) {
  auto s = std::make_shared<CppShader>();
  s->add("density", {{"p", ValueType::Vec3}}, ValueType::Number,
         [](const double* in, double* out) { return out[0] = 1, in[0] > 0 ? FaultCode::Error : FaultCode::None; });
  testing::Rendering r = testing::render_text(
      kThrough + settings(4, 8) + "box{ material = material{ color = 0, shader = 'fake.lua' } }", s);
  ASSERT_EQ(r.error, "");
  EXPECT_GT(r.result.fault_count, 0u);
  for (const Vec3& p : r.result.picture.pixels)
    EXPECT_TRUE(is_finite(p) && p.y <= 1 && p.x == p.y); // no magenta
}

TEST(Volumes, PhotonsPassThem) {
  // A diffuse floor under a scattering box: both integrators see the same light.
  std::string scene =
      "camera{ from = {0, 1, 4}, to = {0, 0.5, 0}, fov = 40 } plane{ size = 10, material = material{ name = "
      "'floor', color = 0.7, ior = 1 } } box{ center = {0, 1, 0}, size = 0.8, material = material{ color "
      "= 0.9, density = 3 } } light{ type = 'sun', direction = {0.3, 1, 0.4}, color = 3 } render{ width = "
      "24, height = 16, depth = 8, photons = 20000, samples = ";
  float path = mean_of(scene + "256, integrator = 'path' }").x;
  float sppm = mean_of(scene + "48, integrator = 'sppm' }").x;
  EXPECT_NEAR(sppm, path, 0.03f * path);
}

} // namespace
} // namespace moonshade::renderer
