// Every kind of light against a closed form, sampled as the path tracer does and summed as Whitted does.
#include "renderer/test_support.h"

#include <OpenImageIO/imageio.h>
#include <atomic>
#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using ::testing::AllOf;
using testing::CppShader;
using ::testing::HasSubstr;
using testing::render_text;
using testing::Rendering;
using testing::TemporaryFolder;

Vec3 mean(const Picture& picture) {
  DVec3 sum(0);
  for (const Vec3& p : picture.pixels)
    sum += DVec3(p);
  return Vec3(sum / double(picture.pixels.size()));
}

Vec3 mean_of(const std::string& scene, std::shared_ptr<const Shader> shader = nullptr) {
  Rendering rendering = render_text(scene, std::move(shader));
  EXPECT_EQ(rendering.error, "");
  return rendering.error.empty() ? mean(rendering.result.picture) : Vec3(-1);
}

void expect_close(const Vec3& actual, const Vec3& expected, float relative) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(actual[c], expected[c], relative * std::abs(expected[c]) + 1e-6f) << "component " << c;
}

std::string settings(int samples, const std::string& integrator = "path") {
  return "render{ width = 8, height = 8, samples = " + std::to_string(samples) + ", integrator = '" + integrator +
         "' }\n";
}

/// The origin of a diffuse floor of colour 0.5, from aside.
const std::string kFloor = "camera{ from = {0.5, 1, 0}, to = {0, 0, 0}, fov = 0.01 } plane{ size = 100, material = "
                           "material{ color = 0.5, ior = 1 } }\n";

std::shared_ptr<CppShader> emitter(std::function<Vec3(const Vec3& p)> function) {
  auto s = std::make_shared<CppShader>();
  s->add("emission", {{"p", ValueType::Vec3}}, ValueType::Vec3, [function](const double* in, double* out) {
    Vec3 value = function(Vec3(in[0], in[1], in[2]));
    for (int c = 0; c < 3; ++c)
      out[c] = value[c];
    return FaultCode::None;
  });
  return s;
}

const std::string kGlowing = ", material = material{ shader = 'fake.lua', color = 0, ior = 1 } }";

TEST(ShadersAsLights, SquaresShineByTheirAverage) {
  double x = 0.5, corner = 1 / (2 * M_PI) * 2 * (x / std::sqrt(1 + x * x)) * std::atan(x / std::sqrt(1 + x * x));
  float expected = float(0.5 * 7 * 4 * corner);
  std::string scene = kFloor + "rectangle{ center = {0, 2, 0}, u = {1, 0, 0}, v = {0, 0, 1}" + kGlowing;
  for (const char* integrator : {"path", "whitted"}) {
    expect_close(mean_of(scene + settings(64, integrator), emitter([](const Vec3&) { return Vec3(7); })),
                 Vec3(expected), 0.02f);
    // Half of it dark: the floor lies on the symmetry plane, and gets half.
    expect_close(
        mean_of(scene + settings(256, integrator), emitter([](const Vec3& p) { return Vec3(p.x > 0 ? 7 : 0); })),
        Vec3(expected / 2), 0.02f);
  }
  // What the user says of the average changes what is sampled, and nothing of the result.
  std::string told = scene;
  told.insert(told.find("color = 0, ior = 1 } }") + 18, ", average_emission = {3, 2, 1}");
  expect_close(mean_of(told + settings(256), emitter([](const Vec3&) { return Vec3(7); })), Vec3(expected), 0.02f);
}

TEST(ShadersAsLights, SpheresToo) {
  std::string scene = kFloor + "sphere{ center = {0, 4, 0}, radius = 1" + kGlowing;
  for (const char* integrator : {"path", "whitted"})
    expect_close(mean_of(scene + settings(64, integrator), emitter([](const Vec3&) { return Vec3(7, 1, 0); })),
                 Vec3(0.5f * 7 / 16, 0.5f / 16, 0), 0.01f);
}

TEST(ShadersAsLights, DarkOnesAreNoLights) {
  EXPECT_EQ(mean_of(kFloor + "sphere{ center = {0, 4, 0}" + kGlowing + settings(4),
                    emitter([](const Vec3&) { return Vec3(0); })),
            Vec3(0));
}

TEST(ShadersAsLights, TransparentOnesGiveWhatIsThere) {
  std::string scene = kFloor + "sphere{ center = {0, 4, 0}, radius = 1, material = material{ emission = 7, opacity = "
                               "0.25, color = 0, ior = 1 } }";
  // Front and back of the sphere shine through each other: 1 - (1 - 0.25)^2 of the whole.
  expect_close(mean_of(scene + settings(512)), Vec3(0.5f * 7 / 16 * (1 - 0.75f * 0.75f)), 0.02f);
}

TEST(Ellipsoids, AreSampledByArea) {
  std::string sphere =
      "sphere{ center = {0, 4, 0}, radius = 2, scale = {0.5, 1, 0.501}, material = material{ emission = "
      "7, color = 0, ior = 1 } }";
  // Seen from below, a sphere of radius 2 stretched to half its width: by the same points as one ellipse.
  // Irradiance of an ellipsoid of half axes a, b, a at height h above: pi L a^2 / (h^2 - b^2 + a^2).
  float a = 1, b = 2, h = 4;
  expect_close(mean_of(kFloor + sphere + settings(512)), Vec3(0.5f * 7 * a * a / (h * h - b * b + a * a)), 0.01f);
}

TEST(Spots, ShineInTheirCone) {
  // Straight down from 2 above, beside the axis by the angle t: intensity falls off smoothly between 15 and 30 degrees.
  auto at = [&](float degrees) {
    float x = 2 * std::tan(degrees * kPi / 180);
    return "camera{ from = {" + std::to_string(x) + ", 1, 0}, to = {" + std::to_string(x) +
           ", 0, 0}, up = {0, 0, 1}, fov = 0.01 } plane{ size = 100, material = material{ color = 0.5, ior = 1 } } "
           "light{ type = 'spot', position = {0, 2, 0}, to = {0, 0, 0}, angle = 60, blend = 0.5, color = 10 }";
  };
  auto unshaded = [](float degrees) {
    float c = std::cos(degrees * kPi / 180);
    return 0.5f / kPi * 10 * c * c * c / 4;
  };
  for (const char* integrator : {"path", "whitted"}) {
    for (float degrees : {0.0f, 10.0f})
      expect_close(mean_of(at(degrees) + settings(4, integrator)), Vec3(unshaded(degrees)), 1e-3f);
    float t = (std::cos(22 * kPi / 180) - std::cos(kPi / 6)) / (std::cos(kPi / 12) - std::cos(kPi / 6));
    expect_close(mean_of(at(22) + settings(4, integrator)), Vec3(unshaded(22) * t * t * (3 - 2 * t)), 1e-3f);
    EXPECT_EQ(mean_of(at(31) + settings(4, integrator)), Vec3(0));
  }
}

std::shared_ptr<CppShader> surroundings(std::function<Vec3(const Vec3& i)> function) {
  auto s = std::make_shared<CppShader>();
  s->add("environment", {{"i", ValueType::Vec3}}, ValueType::Vec3, [function](const double* in, double* out) {
    Vec3 value = function(Vec3(in[0], in[1], in[2]));
    for (int c = 0; c < 3; ++c)
      out[c] = value[c];
    return FaultCode::None;
  });
  return s;
}

const std::string kAround = "light{ type = 'environment', shader = 'fake.lua' } ";

TEST(Environments, OfShadersLightWhatTheyShould) {
  for (const char* integrator : {"path", "whitted"}) {
    // Uniform: the floor's colour. Rising with height: albedo / pi * integral of cos^2 = 2/3 of it.
    expect_close(
        mean_of(kFloor + kAround + settings(64, integrator), surroundings([](const Vec3&) { return Vec3(1, 2, 3); })),
        Vec3(0.5f, 1, 1.5f), 0.01f);
    expect_close(mean_of(kFloor + kAround + settings(256, integrator),
                         surroundings([](const Vec3& i) { return Vec3(std::max(i.y, 0.0f)); })),
                 Vec3(0.5f * 2 / 3), std::string(integrator) == "path" ? 0.01f : 0.05f); // harmonics approximate
  }
}

TEST(Environments, SmallBrightOnesAreFound) {
  // A disc of 2 degrees about a direction 30 degrees from the zenith.
  Vec3 to(0.5f, std::sqrt(0.75f), 0);
  float cosine = std::cos(kPi / 180);
  auto sun = surroundings([=](const Vec3& i) { return Vec3(glm::dot(i, to) > cosine ? 1000 : 0); });
  float expected = 0.5f / kPi * 1000 * 2 * kPi * (1 - cosine) * to.y;
  expect_close(mean_of(kFloor + kAround + settings(256), sun), Vec3(expected), 0.03f);
}

TEST(Environments, AreSeenAsTheyAre) {
  // A tilted view past everything; rotated by 90 degrees, what was towards +x is towards -z.
  auto colours = surroundings([](const Vec3& i) { return i * 0.5f + Vec3(0.5f); });
  std::string view = "camera{ from = {0, 0, 0}, to = {0, 0.6, -0.8}, fov = 0.01 } sphere{ center = {0, -50, 0} } ";
  expect_close(mean_of(view + kAround + settings(1), colours), Vec3(0.5f, 0.8f, 0.1f), 1e-3f);
  std::string turned = view + "light{ type = 'environment', shader = 'fake.lua', rotate = 90, color = {1, 2, 3} } ";
  expect_close(mean_of(turned + settings(1), colours), Vec3(0.9f, 1.6f, 1.5f), 1e-3f);
}

TEST(Environments, OfImagesHaveTheirMiddleInFront) {
  TemporaryFolder folder;
  constexpr int kWidth = 64, kHeight = 32;
  std::vector<float> pixels(kWidth * kHeight * 3, 0.0f);
  // A bright block around (u, v) = (1/2, 1/4): 45 degrees up, towards -z.
  for (int y = 7; y < 9; ++y)
    for (int x = 31; x < 33; ++x)
      for (int c = 0; c < 3; ++c)
        pixels[size_t((y * kWidth + x) * 3 + c)] = 100.0f * float(c + 1);
  auto out = OIIO::ImageOutput::create(folder / "sky.exr");
  ASSERT_TRUE(out);
  OIIO::ImageSpec spec(kWidth, kHeight, 3, OIIO::TypeDesc::FLOAT);
  ASSERT_TRUE(out->open(folder / "sky.exr", spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) &&
              out->close());
  auto render_scene = [&](const std::string& text) {
    Folders folders = folder.folders();
    SceneReading reading = parse_lua_scene(folder / "scene.lua", text, folders);
    EXPECT_EQ(reading.error, "");
    testing::FixedShaders shaders;
    Preparation preparation = prepare(std::move(*reading.scene), shaders);
    EXPECT_EQ(preparation.error, "");
    if (!preparation.prepared) return Vec3(-1);
    RenderProgress progress;
    return mean(render(*preparation.prepared, {}, progress).picture);
  };
  std::string light = "light{ type = 'environment', image = 'sky.exr' } ";
  std::string view = "camera{ from = {0, 0, 0}, to = {0, 1, -1}, fov = 0.01 } sphere{ center = {0, -50, 0} } ";
  expect_close(render_scene(view + light + settings(1)), Vec3(100, 200, 300), 1e-3f);
  // The floor gets radiance * solid angle * cosine, pixels being interpolated between their middles.
  float solid = 4 * (2 * kPi / kWidth) * (kPi / kHeight) * std::sin(kPi / 4);
  expect_close(render_scene(kFloor + light + settings(1024)),
               Vec3(100, 200, 300) * (0.5f / kPi * solid * std::sqrt(0.5f)), 0.03f);
}

TEST(Environments, RefuseImagesThatAreNoneOrTooLarge) {
  TemporaryFolder folder;
  folder.write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n");
  folder.write("page.png", "<html>");
  folder.write("picture.gif", "GIF89a");
  for (const auto& [file, error] : std::map<std::string, std::string>{
           {"huge.hdr", "it is too large"}, {"page.png", "page.png: "}, {"picture.gif", "no image that is read"}}) {
    const Folders folders = folder.folders();
    const std::string text = "sphere{} light{ type = 'environment', image = '" + file + "' }";
    SceneReading reading = parse_lua_scene(folder / "s.lua", text, folders);
    ASSERT_TRUE(reading.scene) << reading.error;
    testing::FixedShaders shaders;
    EXPECT_THAT(prepare(std::move(*reading.scene), shaders).error, AllOf(HasSubstr("s.lua:1: "), HasSubstr(error)));
  }
}

/// A shader that does not end costs a million steps a point: what is measured before the render looks at few of them.
TEST(Environments, AndLightsThatDoNotEndAreNotMeasuredForLong) {
  std::atomic<int> points = 0;
  auto s = std::make_shared<CppShader>();
  for (const char* entry : {"environment", "emission"})
    s->add(entry, {}, ValueType::Vec3, [&](const double*, double*) { return ++points, FaultCode::StepLimit; });
  const std::string scene =
      kAround + kAround +
      "for x = 1, 9 do sphere{ center = {x, -50, 0}, material = material{ emission = 'fake.lua' } } end ";
  EXPECT_EQ(render_text(scene + "render{ width = 1, height = 1, samples = 1 }", s).error, "");
  EXPECT_LT(points, 20000);
}

TEST(Environments, FaultsAreSeenAndGiveNoLight) {
  auto s = std::make_shared<CppShader>();
  s->add("environment", {{"i", ValueType::Vec3}}, ValueType::Vec3,
         [](const double*, double*) { return FaultCode::Index; });
  Rendering seen = render_text("camera{ from = {0, 0, 0}, to = {0, 1, 0.1}, fov = 1 } sphere{ center = {0, -50, 0} } " +
                                   kAround + settings(1),
                               s);
  EXPECT_EQ(mean(seen.result.picture), Vec3(1, 0, 1));
  EXPECT_GT(seen.result.fault_count, 0u);
  EXPECT_EQ(mean_of(kFloor + kAround + settings(4), s), Vec3(0));
}

TEST(Environments, ErrorsNameThePlace) {
  EXPECT_THAT(render_text("sphere{} light{ type = 'environment' }").error, HasSubstr("either 'image' or 'shader'"));
  EXPECT_THAT(render_text("sphere{} light{ type = 'environment', image = 'fake.lua' }").error, HasSubstr("fake.lua"));
  std::string many = "sphere{} ";
  for (int k = 0; k < 5; ++k)
    many += kAround;
  EXPECT_THAT(render_text(many).error, HasSubstr("light: a scene has at most 4 environments"));
  auto wrong = std::make_shared<CppShader>();
  wrong->add("environment", {{"uv", ValueType::Vec2}}, ValueType::Vec3, {});
  EXPECT_THAT(render_text("sphere{} " + kAround, wrong).error, HasSubstr("the surroundings do not have"));
  auto none = std::make_shared<CppShader>();
  none->add("color", {}, ValueType::Vec3, {});
  EXPECT_THAT(render_text("sphere{} " + kAround, none).error, HasSubstr("has no function 'environment'"));
}

} // namespace
} // namespace moonshade::renderer
