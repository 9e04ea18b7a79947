// Photon mapping: against the path tracer where both can find the light, against closed forms where only photons can.
#include "renderer/integrators/photon_map.h"
#include "renderer/sampling/sampler.h"
#include "renderer/test_support.h"

#include <gtest/gtest.h>

namespace moonshade::renderer {
namespace {

using testing::CppShader;
using testing::render_text;
using testing::Rendering;

DVec3 mean(const Picture& picture) {
  DVec3 sum(0);
  for (const Vec3& p : picture.pixels)
    sum += DVec3(p);
  return sum / double(picture.pixels.size());
}

Picture picture_of(const std::string& scene, std::shared_ptr<const Shader> shader = nullptr,
                   const RenderOptions& options = {}) {
  Rendering rendering = render_text(scene, std::move(shader), options);
  EXPECT_EQ(rendering.error, "");
  return std::move(rendering.result.picture);
}

TEST(PhotonMap, FindsWhatIsNear) {
  std::vector<Photon> photons;
  for (uint32_t k = 0; k < 1000; ++k) {
    Sampler s(1, k, 0);
    Vec2 u = s.two(0);
    photons.push_back({Vec3(u, s.one(1)), Vec3(float(k)), {}, {}, 0});
  }
  PhotonMap map(photons, 1000, 1);
  for (uint32_t k = 0; k < 50; ++k) {
    Vec3 at(Sampler(2, k, 0).two(0), 0.5f);
    float radius = 0.02f * float(k % 10 + 1);
    double expected = 0, found = 0;
    for (const Photon& p : photons)
      if (glm::distance(p.position, at) <= radius) expected += double(p.power.x) + 1;
    map.near(at, radius, [&](const Photon& p) { found += double(p.power.x) + 1; });
    EXPECT_EQ(found, expected);
  }
}

TEST(Sppm, LightsWhatLiesBehindGlass) {
  // The sun straight down through a smooth slab onto a dark floor: (1 - R)^2 of it arrives, without what bounces within
  // (five edges would). The path tracer finds nothing: its light is a point, and the slab bends every way to it.
  std::string scene = "camera{ from = {0.5, 0.6, 0}, to = {0, 0, 0}, fov = 1 } light{ type = 'sun', direction = {0, 1, "
                      "0}, color = 3, angle = 0 } plane{ size = 20, material = material{ name = 'floor', color = 0.5, "
                      "ior = 1 } } box{ center = {0, 1, 0}, size = {8, 0.2, 8}, material = material{ name = 'slab', "
                      "color = 1, roughness = 0, transmission = 1 } } render{ width = 8, height = 8, samples = 16, "
                      "depth = 4, photons = 50000, integrator = '";
  float expected = 0.5f / kPi * 3 * 0.96f * 0.96f;
  EXPECT_NEAR(mean(picture_of(scene + "sppm' }")).x, double(expected), 0.03 * double(expected));
  EXPECT_LT(mean(picture_of(scene + "path' }")).x, 0.02 * double(expected)); // what mirrors on the slab's lower side
}

/// Two walls and a ball over a floor: much light that has bounced.
const std::string kRoom =
    "camera{ from = {0, 1.4, 4.5}, to = {0, 0.7, 0}, fov = 40 } plane{ size = 12, material = material{ name = 'floor', "
    "color = {0.8, 0.7, 0.6}, ior = 1 } } plane{ point = {0, 0, -1.5}, normal = {0, 0, 1}, size = 12, material = "
    "material{ name = 'wall', color = {0.7, 0.3, 0.2} } } box{ center = {-1.6, 1, 0}, size = {0.2, 2, 3}, material = "
    "material{ name = 'side', color = {0.2, 0.6, 0.3}, roughness = 0.8 } } sphere{ center = {0.6, 0.5, 0}, radius = "
    "0.5, "
    "material = material{ name = 'ball', color = {0.9, 0.8, 0.5}, metallic = 0.7, roughness = 0.6 } } ";

/// Mean difference, and the root mean square of differences over blocks of 8 x 8 pixels, relative to the mean.
std::pair<double, double> apart(const Picture& a, const Picture& b) {
  double mean_a = 0, mean_b = 0, squares = 0;
  int blocks = 0;
  for (int by = 0; by < a.height; by += 8)
    for (int bx = 0; bx < a.width; bx += 8, ++blocks) {
      double sum_a = 0, sum_b = 0;
      for (int y = by; y < by + 8; ++y)
        for (int x = bx; x < bx + 8; ++x)
          sum_a += double(luminance(a.at(x, y))) / 64, sum_b += double(luminance(b.at(x, y))) / 64;
      mean_a += sum_a, mean_b += sum_b, squares += (sum_a - sum_b) * (sum_a - sum_b);
    }
  mean_a /= blocks, mean_b /= blocks;
  return {(mean_b - mean_a) / mean_a, std::sqrt(squares / blocks) / mean_a};
}

TEST(Sppm, AgreesWithPathUnderEveryLight) {
  auto glow = std::make_shared<CppShader>();
  glow->add("emission", {{"p", ValueType::Vec3}}, ValueType::Vec3, [](const double* in, double* out) {
    return out[0] = out[1] = out[2] = in[0] > 0 ? 6 : 1, FaultCode::None;
  });
  auto dusk = std::make_shared<CppShader>();
  dusk->add("environment", {{"i", ValueType::Vec3}}, ValueType::Vec3, [](const double* in, double* out) {
    return out[0] = out[1] = out[2] = in[1] > 0.6 ? 3 : 0.2, FaultCode::None;
  });
  struct Case {
    std::string light;
    std::shared_ptr<CppShader> shader;
  };
  const Case cases[] = {
      {"light{ type = 'point', position = {0.5, 2, 1}, color = 5 }", nullptr},
      {"light{ type = 'spot', position = {0.5, 2.5, 1.5}, to = {0, 0, -0.5}, color = 12, angle = 70 }", nullptr},
      {"light{ type = 'sun', direction = {0.5, 1, 0.6}, color = 3, angle = 1 }", nullptr},
      {"light{ type = 'sky', zenith = {0.5, 0.7, 1}, horizon = 0.8, ground = 0.3 }", nullptr},
      {"light{ type = 'area', center = {0.5, 2.2, 0.5}, u = {0.5, 0, 0}, v = {0, 0, 0.5}, color = 9 }", nullptr},
      {"sphere{ center = {0.5, 2, 0.8}, radius = 0.3, scale = {1, 0.7, 1}, material = material{ emission = 9, color = "
       "0, "
       "ior = 1 } }",
       nullptr},
      {"rectangle{ center = {0.3, 2.2, 0.5}, u = {0.5, 0, 0}, v = {0, 0, 0.5}, material = material{ shader = "
       "'fake.lua', "
       "color = 0, ior = 1 } }",
       glow},
      {"light{ type = 'environment', shader = 'fake.lua' }", dusk}};
  for (const Case& c : cases) {
    auto settings = [](const char* integrator, int samples) {
      return "render{ width = 32, height = 24, depth = 6, photons = 20000, samples = " + std::to_string(samples) +
             ", integrator = '" + integrator + "' } ";
    };
    Picture path = picture_of(settings("path", 128) + kRoom + c.light, c.shader);
    Picture sppm = picture_of(settings("sppm", 32) + kRoom + c.light, c.shader);
    auto [bias, blocks] = apart(path, sppm);
    // Photons are blurred over their radius: some darkening along edges is left after so few passes.
    EXPECT_NEAR(bias, 0, 0.025) << c.light;
    EXPECT_LT(blocks, 0.06) << c.light;
  }
}

TEST(Irradiance, ComesNearThePathTracer) {
  // The error that docs/integrators.md states, in a room of mostly bounced light.
  for (const char* light : {"light{ type = 'point', position = {0.5, 2, 1}, color = 5 }",
                            "light{ type = 'sky', zenith = {0.5, 0.7, 1}, horizon = 0.8, ground = 0.3 }"}) {
    auto settings = [](const char* integrator, int samples) {
      return "render{ width = 96, height = 72, depth = 4, samples = " + std::to_string(samples) + ", integrator = '" +
             integrator + "' } ";
    };
    auto [bias, blocks] = apart(picture_of(settings("path", 128) + kRoom + light),
                                picture_of(settings("irradiance", 16) + kRoom + light));
    EXPECT_NEAR(bias, 0, 0.05) << light;
    EXPECT_LT(blocks, 0.08) << light;
  }
}

TEST(Irradiance, ThreadsChangeNothing) {
  std::string scene = "render{ width = 60, height = 40, samples = 2, integrator = 'irradiance' } " + kRoom +
                      "light{ type = 'point', position = {0.5, 2, 1}, color = 5 }";
  Picture one = picture_of(scene, nullptr, {.threads = 1});
  for (unsigned threads : {2u, 3u, 5u})
    EXPECT_EQ(picture_of(scene, nullptr, {.threads = threads}).pixels, one.pixels) << threads;
}

TEST(Sppm, ThreadsAndPassesChangeNothing) {
  std::string scene = "render{ width = 40, height = 30, samples = 3, photons = 9000, integrator = 'sppm' } " + kRoom +
                      "light{ type = 'point', position = {0.5, 2, 1}, color = 5 }";
  Picture one = picture_of(scene, nullptr, {.threads = 1});
  for (unsigned threads : {2u, 3u, 5u})
    EXPECT_EQ(picture_of(scene, nullptr, {.threads = threads}).pixels, one.pixels) << threads;
  // A part of the picture is that part of the whole.
  Picture part = picture_of(scene, nullptr, {.threads = 2, .crop = Crop{10, 5, 20, 15}});
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x)
      EXPECT_EQ(part.at(x, y), one.at(x + 10, y + 5)) << x << " " << y;
}

TEST(Sppm, StopsAtTheNoiseAskedForAndIsNotFooledBySharedPhotons) {
  // Neighbours see the same photons, but a pixel's passes have photons of their own: the error that its samples show is
  // that of its mean. Two seeds' difference says what it really is, in a picture encoded by a square root.
  constexpr double kLevel = 0.006;
  auto render_seed = [](int seed, unsigned threads) {
    return testing::render_text("render{ width = 64, height = 48, depth = 5, photons = 4000, samples = 1500, "
                                "integrator = 'sppm', seed = " +
                                    std::to_string(seed) + " } " + kRoom +
                                    "light{ type = 'point', position = {0.5, 2, 1}, color = 5 }",
                                nullptr, {.threads = threads, .noise = kLevel});
  };
  testing::Rendering a = render_seed(1, 2), b = render_seed(2, 3);
  ASSERT_EQ(a.error + b.error, "");
  EXPECT_TRUE(a.result.finished);
  EXPECT_LT(a.result.samples, 1500u);
  double squares = 0;
  for (size_t k = 0; k < a.result.picture.pixels.size(); ++k) {
    double apart = std::sqrt(double(luminance(a.result.picture.pixels[k]))) -
                   std::sqrt(double(luminance(b.result.picture.pixels[k])));
    squares += apart * apart / 2;
  }
  double error = std::sqrt(squares / double(a.result.picture.pixels.size()));
  EXPECT_LT(error, kLevel);
  EXPECT_GT(error, 0.3 * kLevel); // nor does it go on for long where it could stop
  EXPECT_EQ(render_seed(1, 1).result.picture.pixels, a.result.picture.pixels);
}

TEST(Sppm, ExtrapolatedToNoRadiusIsWhatPathsSee) {
  // The blur of a photon map goes with the square of its radius: two numbers of passes give the mean at radius 0.
  auto mean = [](const std::string& settings) {
    Picture picture = picture_of("render{ width = 32, height = 24, depth = 6, photons = 20000, " + settings + " } " +
                                 kRoom + "light{ type = 'point', position = {0.5, 2, 1}, color = 5 }");
    double sum = 0;
    for (const Vec3& p : picture.pixels)
      sum += double(luminance(p));
    return sum / double(picture.pixels.size());
  };
  auto mean_square_radius = [](int passes) {
    double sum = 0, squared = 1;
    for (int k = 0; k < passes; ++k, squared *= (k + 2.0 / 3) / (k + 1))
      sum += squared;
    return sum / passes;
  };
  double few = mean("integrator = 'sppm', samples = 8"), many = mean("integrator = 'sppm', samples = 96, seed = 1");
  double b_few = mean_square_radius(8), b_many = mean_square_radius(96);
  double extrapolated = many + (many - few) * b_many / (b_few - b_many), path = mean("samples = 1024");
  EXPECT_LT(few, path); // photons are lost along edges
  EXPECT_NEAR(many / path, 1, 0.008);
  EXPECT_NEAR(extrapolated / path, 1, 0.005);
}

} // namespace
} // namespace moonshade::renderer
