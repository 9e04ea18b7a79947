// Film, AOVs' words, adaptive sampling, packets to tev.
#include "renderer/film/film.h"

#include "renderer/film/adaptive.h"
#include "renderer/film/aov.h"
#include "renderer/film/tev_display.h"
#include "renderer/sampling/sampler.h"
#include "renderer/test_support.h"

#include <cstring>
#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::render_text;
using testing::Rendering;

TEST(Film, MeansAndVariancesOfSamples) {
  Film film(1, 1, {.squares = true, .first = false});
  Vec3 samples[] = {Vec3(1, 0, 2), Vec3(2, 0, 2), Vec3(6, 3, 2)};
  uint8_t faulted[] = {0, 0, 1};
  film.add(0, {samples, faulted, nullptr}, 0, 1);
  EXPECT_EQ(film.variance(0), Vec3(0)); // nothing is known from one
  film.add(0, {samples, faulted, nullptr}, 1, 2);
  EXPECT_EQ(film.mean(0), Vec3(3, 1, 2));
  // Sample variance 7 and 3, over three samples.
  EXPECT_NEAR(film.variance(0).x, 7.0f / 3, 1e-6f);
  EXPECT_NEAR(film.variance(0).y, 1.0f, 1e-6f);
  EXPECT_EQ(film.variance(0).z, 0);
  EXPECT_EQ(film.samples(0), 3u);
  EXPECT_EQ(film.faults(0), 1u);
}

TEST(Aovs, AreNamedOnTheCommandLine) {
  AovList aovs;
  EXPECT_EQ(parse_aovs("depth,albedo,depth", aovs), "");
  EXPECT_THAT(aovs, ElementsAre(Aov::Albedo, Aov::Depth));
  EXPECT_EQ(parse_aovs("id", aovs), "");
  EXPECT_THAT(aovs, ElementsAre(Aov::Object, Aov::Material));
  EXPECT_EQ(parse_aovs("all", aovs), "");
  EXPECT_EQ(aovs.size(), kAovCount);
  EXPECT_THAT(parse_aovs("depht", aovs), HasSubstr("--aov: unknown 'depht'; did you mean 'depth'?"));
  EXPECT_THAT(parse_aovs("", aovs), HasSubstr("unknown ''"));
  EXPECT_THAT(parse_aovs("depth,", aovs), HasSubstr("unknown ''"));
  EXPECT_FALSE(contents_for({Aov::Samples}).first);
  EXPECT_TRUE(contents_for({Aov::Depth}).first);
  EXPECT_TRUE(contents_for({Aov::Variance}).squares);
}

TEST(Aovs, ShowWhatTheCameraSees) {
  // A red ball of radius 1 around the origin, four away; a camera that looks along -z.
  RenderOptions options;
  options.contents = {.squares = true, .first = true};
  Rendering r = render_text(
      "render{ width = 33, height = 33, samples = 16 } camera{ from = {0, 0, 4}, to = {0, 0, 0}, fov = 60 }"
      "box{ center = {100, 0, 0} } sphere{ material = material{ color = {1, 0.5, 0.25}, reflectance = 0.5 } }",
      nullptr, options);
  ASSERT_EQ(r.error, "");
  const Film& film = *r.result.film;
  Film::First center = film.first(16 * 33 + 16), corner = film.first(0);
  EXPECT_NEAR(center.albedo.x, 1, 1e-6);
  EXPECT_NEAR(center.albedo.y, 0.75, 1e-6);
  EXPECT_NEAR(center.normal.z, 1, 1e-2);
  EXPECT_NEAR(center.depth, 3, 1e-2);
  EXPECT_NEAR(center.position.z, 1, 1e-2);
  EXPECT_EQ(center.object, 2u);
  EXPECT_EQ(center.material, 2u); // after the default one
  EXPECT_EQ(corner.object, 0u);
  EXPECT_EQ(corner.depth, FirstHit::kNoDepth);
  EXPECT_EQ(corner.albedo, DVec3(0));
  // Depth is measured along the axis: it is the same all over a wall.
  Rendering wall = render_text("render{ width = 9, height = 9, samples = 1 } camera{ from = {0, 0, 4}, to = {0, 0, 0}, "
                               "fov = 90 } plane{ normal = {0, 0, 1} }",
                               nullptr, options);
  for (size_t k = 0; k < 81; ++k)
    EXPECT_NEAR(wall.result.film->first(k).depth, 4, 1e-5);
}

/// A film whose pixels are noise around one half, of this standard deviation.
Film noisy(int size, float deviation, uint32_t samples) {
  Film film(size, size, {.squares = true, .first = false});
  for (size_t pixel = 0; pixel < film.pixel_count(); ++pixel)
    for (uint32_t s = 0; s < samples; ++s) {
      Vec3 value(0.5f + deviation * std::sqrt(12.0f) * (unit_float(hash_combine(uint32_t(pixel), s)) - 0.5f));
      uint8_t faulted = 0;
      film.add(pixel, {&value, &faulted, nullptr}, 0, 1);
    }
  return film;
}

TEST(Adaptive, EstimatesTheErrorOfASquareRootEncodedPicture) {
  // Standard error 0.1 / sqrt(64) of a mean of 0.5, through the square root's slope there.
  EXPECT_NEAR(Adaptive::error(noisy(16, 0.1f, 64), 0, 0), 0.1 / 8 / (2 * std::sqrt(0.5)), 2e-4);
}

TEST(Adaptive, StopsWhereNoNeighbourNeedsMore) {
  Film film(64, 16, {.squares = true, .first = false});
  uint8_t faulted[2] = {};
  Vec3 values[2] = {Vec3(0), Vec3(1)};
  film.add(5, {values, faulted, nullptr}, 0, 2); // noise in the first block only
  Adaptive adaptive(64, 16, 0.01);
  adaptive.decide(film);
  EXPECT_TRUE(adaptive.active(0, 0));
  EXPECT_TRUE(adaptive.active(16, 0)); // its neighbour
  EXPECT_FALSE(adaptive.active(32, 0));
  EXPECT_FALSE(adaptive.active(63, 15));
  EXPECT_TRUE(adaptive.any());
}

TEST(Adaptive, SpendsSamplesWhereTheNoiseIsAndMeetsTheLevel) {
  RenderOptions options;
  options.noise = 0.01;
  const std::string scene = "camera{ from = {0, 2, 6}, to = {0, 0.5, 0} } plane{ material = material{ ior = 1 } }"
                            "sphere{ center = {0, 1, 0}, radius = 0.8 } light{ type = 'sky' }"
                            "render{ width = 96, height = 64, samples = 2000 }";
  Rendering r = render_text(scene, nullptr, options);
  ASSERT_EQ(r.error, "");
  EXPECT_TRUE(r.result.finished);
  EXPECT_LT(r.result.samples, 2000u);
  EXPECT_LT(r.result.mean_samples, 0.9 * r.result.samples);
  EXPECT_EQ(r.result.samples % Adaptive::kInterval, 0u);
  for (int y = 0; y < 64; y += 16)
    for (int x = 0; x < 96; x += 16)
      EXPECT_LE(Adaptive::error(*r.result.film, x, y), 0.01);
  // The same picture whatever the number of threads.
  options.threads = 3;
  Rendering again = render_text(scene, nullptr, options);
  EXPECT_EQ(again.result.picture.pixels, r.result.picture.pixels);
}

TEST(Adaptive, HasNoBiasWorthNoting) {
  // The mean over many seeds against one render with all samples: within the noise of the comparison, which is some
  // hundred times less than the level asked for.
  const std::string scene = "camera{ from = {0, 2, 6}, to = {0, 0.5, 0} } plane{ material = material{ ior = 1 } }"
                            "box{ center = {0, 0.6, 0} } light{ type = 'area', center = {1, 3, 1}, color = 8 }"
                            "render{ width = 32, height = 32, depth = 3, ";
  auto mean = [&](const std::string& settings, double noise) {
    RenderOptions options;
    options.noise = noise;
    Rendering r = render_text(scene + settings + " }", nullptr, options);
    EXPECT_EQ(r.error, "");
    double sum = 0;
    for (const Vec3& p : r.result.picture.pixels)
      sum += double(p.x);
    return sum / (32 * 32);
  };
  double reference = mean("samples = 4096, seed = 99", 0), sum = 0;
  constexpr int kSeeds = 40;
  for (int seed = 0; seed < kSeeds; ++seed)
    sum += mean("samples = 512, seed = " + std::to_string(seed), 0.03);
  EXPECT_NEAR(sum / kSeeds / reference, 1, 5e-4);
}

template <typename T> T take(const std::string& bytes, size_t& at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return value;
}

TEST(Tev, PacketsSayTheirLengthAndKind) {
  std::string create = TevDisplay::create_packet("a.png", 3, 2);
  size_t at = 0;
  EXPECT_EQ(take<uint32_t>(create, at), create.size());
  EXPECT_EQ(take<uint8_t>(create, at), 4);
  EXPECT_EQ(create.substr(6), std::string("a.png\0\3\0\0\0\2\0\0\0\3\0\0\0R\0G\0B\0", 24));
  Picture picture{1, 2, {Vec3(1, 2, 3), Vec3(4, 5, 6)}};
  std::string update = TevDisplay::update_packet("a", picture);
  EXPECT_EQ(update.size(), 4u + 1 + 1 + 2 + 4 + 6 + 16 + 48 + 24);
  EXPECT_EQ(update[4], 6);
  at = update.size() - 4;
  EXPECT_EQ(take<float>(update, at), 6.0f);
}

TEST(Tev, SaysWhyThereIsNoConnection) {
  TevDisplay display;
  EXPECT_THAT(display.connect("127.0.0.1:1"), HasSubstr("tev at 127.0.0.1:1: Connection refused"));
  EXPECT_THAT(display.connect("no.such.host.invalid"), HasSubstr("tev at no.such.host.invalid:14158: "));
  EXPECT_FALSE(display.connected());
}

} // namespace
} // namespace moonshade::renderer
