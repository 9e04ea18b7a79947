// Hypertextures against closed forms: what passes, what is scattered once and for ever, what glows.
#include "renderer/sampling/warp.h"
#include "renderer/test_support.h"
#include "renderer/volumes/volume_controls.h"

#include <atomic>
#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using testing::CppShader;
using testing::FixedShaders;
using ::testing::HasSubstr;
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

/// A floor at y = 0 under a ball of this radius at height h that glows by 1 per unit of length and absorbs nothing: as
/// gravity is, irradiance is that of a point, of the ball's volume times its glow, at its middle.
std::string under_a_ball(float h, float radius, const std::string& integrator, int samples,
                         const std::string& more = "") {
  return "camera{ from = {0.02, 0.3, 0}, to = {0, 0, 0}, fov = 1 } plane{ material = material{ name = 'floor', color = "
         "0.5, ior = 1 } } sphere{ radius = " +
         std::to_string(radius) + ", translate = {0, " + std::to_string(h) +
         ", 0}, material = material{ color = 0, density = 0, emission = {2, 1, 0} } } light{ type = 'sky', intensity = "
         "0 } render{ width = 8, height = 8, depth = 2, integrator = '" +
         integrator + "', samples = " + std::to_string(samples) + more + " } ";
}
float lit_by_a_ball(float h, float radius) {
  return 0.5f / kPi * (4.0f / 3 * kPi * radius * radius * radius) / (h * h);
}

TEST(Glow, LightsAFloorAsGravityPulls) {
  struct {
    float h, radius;
  } balls[] = {{2, 0.1f}, {2, 0.5f}, {1.5f, 1.0f}, {5, 1.5f}};
  for (auto [h, radius] : balls)
    for (const char* integrator : {"path", "whitted", "sppm", "irradiance"}) {
      float expected = lit_by_a_ball(h, radius);
      Vec3 value = mean_of(under_a_ball(h, radius, integrator, 64, ", photons = 1000"));
      EXPECT_NEAR(value.y, expected, 0.01f * expected) << h << " " << radius << " " << integrator;
      EXPECT_NEAR(value.x, 2 * value.y, 1e-4f * value.x);
    }
}

/// Relative standard deviation of a sample.
float noise_of(const std::string& scene, std::shared_ptr<const Shader> shader = nullptr) {
  testing::Rendering r = testing::render_text(scene, std::move(shader), {.contents = {.squares = true}});
  EXPECT_EQ(r.error, "");
  double variance = 0, mean = 0;
  for (size_t k = 0; k < r.result.film->pixel_count(); ++k) {
    variance += double(r.result.film->variance(k).y) * r.result.samples;
    mean += double(r.result.film->mean(k).y);
  }
  double count = double(r.result.film->pixel_count());
  return float(std::sqrt(variance / count) / (mean / count));
}

TEST(Glow, IsFoundHoweverSmall) {
  // Rays of the floor's own meet a ball of 0.1 at 2 with a probability of 1/400: a deviation of 20 for each sample.
  EXPECT_LT(noise_of(under_a_ball(2, 0.1f, "path", 64)), 1.0f);
  EXPECT_LT(noise_of(under_a_ball(1.02f, 1.0f, "path", 64)), 1.0f);
}

TEST(Glow, OfAShaderIsSampledByWhereItIs) {
  // A bright corner of a box without density otherwise dark; and what a stone before it leaves.
  auto corner = std::make_shared<CppShader>();
  corner->add("density", {{"p", ValueType::Vec3}}, ValueType::Number,
              [](const double*, double* out) { return out[0] = 0, FaultCode::None; });
  corner->add("emission", {{"p", ValueType::Vec3}}, ValueType::Vec3, [](const double* in, double* out) {
    double d = std::hypot(in[0] - 0.3, in[1] - 0.3, in[2] - 0.3);
    return out[0] = out[1] = out[2] = d < 0.15 ? 20 : 0, FaultCode::None;
  });
  std::string scene = "camera{ from = {0.02, 0.3, 0}, to = {0, 0, 0}, fov = 1 } plane{ material = material{ name = "
                      "'floor', color = 0.5, ior = 1 } } box{ translate = {-0.3, 1.7, -0.3}, material = material{ "
                      "color = 0, shader = 'fake.lua' } } render{ width = 8, height = 8, depth = 2, samples = 256, "
                      "photons = 1000 ";
  float expected = 20 * lit_by_a_ball(2, 0.15f);
  for (const char* integrator : {"path", "sppm"})
    EXPECT_NEAR(mean_of(scene + ", integrator = '" + integrator + "' }", corner).x, expected, 0.015f * expected)
        << integrator;
  EXPECT_LT(noise_of(scene + "}", corner), 2.0f);
  EXPECT_EQ(mean_of(scene + "} rectangle{ center = {0, 1, 0}, u = {1, 0, 0}, v = {0, 0, 1}, material = material{ name "
                            "= 'lid', color = 0 } }",
                    corner),
            Vec3(0));
}

TEST(Glow, FadesOnItsWayAndIsScatteredOnce) {
  // A ball that absorbs what it emits: along each ray (1 - exp(-2 s r cos a)) / s, over the angle a to the middle's.
  float h = 2, radius = 0.8f, s = 3;
  double expected = 0;
  constexpr int kSteps = 20000;
  double most = std::asin(double(radius / h));
  for (int k = 0; k < kSteps; ++k) {
    double a = (k + 0.5) / kSteps * most, side = h * std::sin(a);
    double chord = 2 * std::sqrt(std::max(0.0, double(radius) * radius - side * side));
    expected += 2 * double(kPi) * std::sin(a) * std::cos(a) * (1 - std::exp(-s * chord)) / s * (most / kSteps);
  }
  expected *= 0.5 / double(kPi);
  std::string scene = under_a_ball(h, radius, "path", 256);
  scene.replace(scene.find("density = 0"), 11, "density = 3");
  EXPECT_NEAR(mean_of(scene).y, expected, 0.01 * expected);
  // White, it scatters also what it emits, and photons say the same of a wider piece of the floor.
  scene.replace(scene.find("color = 0, density"), 9, "color = 1").replace(scene.find("depth = 2"), 9, "depth = 9");
  EXPECT_GT(mean_of(scene).y, 1.2f * float(expected));
  scene.replace(scene.find("fov = 1"), 7, "fov = 60");
  float path = mean_of(scene).y;
  scene.replace(scene.find("'path'"), 6, "'sppm', photons = 10000")
      .replace(scene.find("samples = 256"), 13, "samples = 24");
  EXPECT_NEAR(mean_of(scene).y, path, 0.03f * path);
}

/// Path tracing and photons see the same light, each with its number of samples, at which `scene` ends.
void expect_same_for_photons(const std::string& scene, const char* of_path, const char* of_photons) {
  const float path = mean_of(scene + of_path + ", integrator = 'path' }").x;
  const float sppm = mean_of(scene + of_photons + ", integrator = 'sppm' }").x;
  EXPECT_NEAR(sppm, path, 0.03f * path);
}

TEST(Glow, InARoomIsTheSameForPathsAndPhotons) {
  // Light that has bounced off a wall, and a mirror that shows the flame and what it lights.
  std::string scene =
      "camera{ from = {0, 1, 5}, to = {0, 0.7, 0}, fov = 50 } plane{ material = material{ name = 'floor', color = 0.7, "
      "ior = 1 } } plane{ point = {0, 0, -1.5}, normal = {0, 0, 1}, material = material{ name = 'wall', color = {0.8, "
      "0.5, 0.4}, ior = 1 } } box{ center = {0.8, 0.5, 0}, size = 0.8, material = material{ color = 0.5, density = 1, "
      "emission = 2 } } sphere{ center = {-0.8, 0.5, 0.2}, radius = 0.5, material = material{ name = 'ball', color = "
      "0.9, metallic = 1, roughness = 0.1 } } render{ width = 24, height = 16, depth = 6, photons = 20000, samples = ";
  expect_same_for_photons(scene, "400", "64");
}

TEST(Controls, AreRaisedBetweenPassesByWhatIsGreatest) {
  TemporaryFolder folder;
  Folders folders = folder.folders();
  SceneReading reading =
      parse_lua_scene(folder / "scene.lua", "sphere{} box{ material = material{ density = 2 } }", folders);
  ASSERT_EQ(reading.error, "");
  FixedShaders shaders;
  Preparation preparation = prepare(std::move(*reading.scene), shaders);
  ASSERT_EQ(preparation.error, "");
  VolumeControls controls(*preparation.prepared->volumes);
  EXPECT_EQ(controls.at(1, 5), 2.5f);
  controls.note(1, 5, 3);
  controls.note(1, 5, 8);
  controls.note(1, 5, 4);
  controls.note(1, 6, 2.4f);
  EXPECT_EQ(controls.at(1, 5), 2.5f); // not within the pass
  controls.raise();
  EXPECT_EQ(controls.at(1, 5), 10);
  EXPECT_EQ(controls.at(1, 6), 2.5f);
  EXPECT_EQ(controls.at(1, 7), 2.5f);
  controls.raise();
  EXPECT_EQ(controls.at(1, 5), 10);
}

TEST(Controls, ThatWereTooLowBringNoiseForAFewPassesOnly) {
  auto ramp = density([](const double* p) { return 4 * (p[0] + 0.5); });
  // Deviation of the pixels' samples 65 to 512, from the pictures of the first 64 and of all.
  auto deviation = [&](float factor) {
    TemporaryFolder folder;
    folder.write("fake.lua", "-- a shader in C++ stands in\n");
    Folders folders = folder.folders();
    SceneReading reading = parse_lua_scene(
        folder / "scene.lua",
        kThrough + settings(512, 8) + "box{ material = material{ color = 0, shader = 'fake.lua' } }", folders);
    FixedShaders shaders(ramp);
    Preparation preparation = prepare(std::move(*reading.scene), shaders);
    preparation.prepared->volumes->multiply_controls(factor);
    Picture first;
    RenderOptions options;
    options.after_pass = [&](RenderState& state, bool) {
      if (state.samples() == 64) first = state.picture();
    };
    RenderProgress progress;
    RenderResult result = render(*preparation.prepared, options, progress);
    double sum = 0;
    for (size_t k = 0; k < result.picture.pixels.size(); ++k) {
      double late = (512.0 * double(result.picture.pixels[k].x) - 64.0 * double(first.pixels.at(k).x)) / 448;
      sum += (late - std::exp(-2.0)) * (late - std::exp(-2.0));
    }
    return std::sqrt(sum / double(result.picture.pixels.size()));
  };
  EXPECT_LT(deviation(0.03f), 1.5 * deviation(1));
}

TEST(Controls, AreTheSameForAnyNumberOfThreads) {
  // Specks so rare that looking at the cells misses most of them.
  auto specks = density([](const double* p) {
    double h = std::sin(p[0] * 127.1 + p[1] * 311.7 + p[2] * 74.7) * 43758.5453;
    return h - std::floor(h) < 3e-4 ? 60.0 : 2.0;
  });
  std::string scene = "camera{ from = {0, 0.6, 4} } light{ type = 'sky' } box{ material = material{ color = 0.9, "
                      "shader = 'fake.lua' } } render{ width = 24, height = 16, samples = 64, photons = 2000, "
                      "integrator = '";
  for (const char* integrator : {"path", "sppm"}) {
    auto picture = [&](unsigned threads) {
      testing::Rendering r = testing::render_text(scene + integrator + "' }", specks, {.threads = threads});
      EXPECT_EQ(r.error, "");
      return r.result.picture.pixels;
    };
    EXPECT_EQ(picture(1), picture(3)) << integrator;
  }
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

TEST(Volumes, OfShadersThatDoNotEndAreNotMeasuredForLong) {
  std::atomic<int> points = 0;
  auto s = std::make_shared<CppShader>();
  s->add("density", {}, ValueType::Number, [&](const double*, double*) { return ++points, FaultCode::StepLimit; });
  const std::string scene =
      "for x = 1, 9 do box{ center = {x, 0, 0}, material = material{ density = 'fake.lua' } } end "
      "render{ width = 1, height = 1, samples = 1 }";
  EXPECT_EQ(testing::render_text(scene, s).error, "");
  EXPECT_LT(points, 20000);
}

TEST(Volumes, AreBoundedInNumber) {
  const std::string scene =
      "local m = material{ density = 1 } for x = 1, 1001 do sphere{ center = {x, 0, 0}, material = m } end";
  EXPECT_THAT(testing::render_text(scene).error, HasSubstr("more than 1000 objects are volumes"));
}

TEST(Volumes, PhotonsPassThem) {
  // A diffuse floor under a scattering box: both integrators see the same light.
  std::string scene =
      "camera{ from = {0, 1, 4}, to = {0, 0.5, 0}, fov = 40 } plane{ size = 10, material = material{ name = "
      "'floor', color = 0.7, ior = 1 } } box{ center = {0, 1, 0}, size = 0.8, material = material{ color "
      "= 0.9, density = 3 } } light{ type = 'sun', direction = {0.3, 1, 0.4}, color = 3 } render{ width = "
      "24, height = 16, depth = 8, photons = 20000, samples = ";
  expect_same_for_photons(scene, "256", "48");
}

} // namespace
} // namespace moonshade::renderer
