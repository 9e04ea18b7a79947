// Pictures against closed forms, independence of threads and of the split of the work, faults, interruption.
#include "renderer/render.h"

#include "renderer/geometry/float_environment.h"
#include "renderer/test_support.h"

#include <gmock/gmock.h>
#include <thread>

namespace moonshade::renderer {
namespace {

using testing::CppShader;
using ::testing::HasSubstr;
using testing::render_text;
using testing::Rendering;

/// The mean of all pixels.
Vec3 mean(const Picture& picture) {
  DVec3 sum(0);
  for (const Vec3& p : picture.pixels)
    sum += DVec3(p);
  return Vec3(sum / double(picture.pixels.size()));
}

/// Looks straight down at the origin from one unit above: every pixel sees (nearly) one point.
const std::string kDown = "camera{ from = {0, 1, 0}, to = {0, 0, 0}, up = {0, 0, -1}, fov = 0.01 }\n";

std::string settings(const std::string& fields) { return "render{ width = 8, height = 8, " + fields + " }\n"; }

Vec3 mean_of(const std::string& scene, std::shared_ptr<const Shader> shader = nullptr) {
  Rendering rendering = render_text(scene, std::move(shader));
  EXPECT_EQ(rendering.error, "");
  return rendering.error.empty() ? mean(rendering.result.picture) : Vec3(-1);
}

void expect_close(const Vec3& actual, const Vec3& expected, float relative) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(actual[c], expected[c], relative * std::abs(expected[c]) + 1e-6f) << "component " << c;
}

TEST(Furnace, LosslessSurfacesVanish) {
  // White under white light: the sphere cannot be told from the sky.
  for (const char* material : {"color = 1, ior = 1", "reflectance = 1", "reflectance = 0.5, color = 1, ior = 1"})
    for (const char* integrator : {"path"}) {
      Rendering r = render_text("camera{ from = {0, 0, 3}, to = {0, 0, 0} } sphere{ material = material{ " +
                                std::string(material) + " } } light{ type = 'sky' }" +
                                settings("samples = 256, depth = 64, integrator = '" + std::string(integrator) + "'"));
      ASSERT_EQ(r.error, "");
      expect_close(mean(r.result.picture), Vec3(1), 0.01f);
    }
}

TEST(Furnace, NoMaterialGivesMoreThanItGets) {
  for (float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f})
    for (const char* kind : {"metallic = 1", "metallic = 0", "metallic = 0.5, ior = 2.5", "metallic = 0, ior = 1.05",
                             "transmission = 1, ior = 1.5", "transmission = 1, thin = true", "opacity = 0.3",
                             "transmission = 0.5, metallic = 0.2, ior = 1.3"}) {
      Vec3 value = mean_of("camera{ from = {0, 0, 2.2}, to = {0, 0, 0}, fov = 50 } sphere{ material = material{ color "
                           "= 1, roughness = " +
                           std::to_string(roughness) + ", " + kind + " } } light{ type = 'sky' }" +
                           settings("samples = 256, depth = 64"));
      EXPECT_LE(value.x, 1.015f) << kind << " " << roughness;
      EXPECT_GE(value.x, 0.98f) << kind << " " << roughness;
    }
}

TEST(ClosedForm, LambertUnderAPointLight) {
  // radiance = albedo / pi * intensity / d^2 * cos; the light stands 3 up and 4 aside.
  float expected = 0.5f / kPi * 10 / 25 * (3.0f / 5);
  for (const char* integrator : {"path", "whitted"})
    expect_close(mean_of(kDown + settings("samples = 4, integrator = '" + std::string(integrator) + "'") +
                         "plane{ size = 100, material = material{ color = 0.5, ior = 1 } } light{ type = 'point', "
                         "position = {4, 3, 0}, color = {10, 20, 40} }"),
                 Vec3(expected, 2 * expected, 4 * expected), 1e-3f);
}

TEST(ClosedForm, NothingInTheShadow) {
  for (const char* integrator : {"path", "whitted"})
    EXPECT_EQ(mean_of(kDown + settings("samples = 4, integrator = '" + std::string(integrator) + "'") +
                      "plane{ size = 100, material = material{ color = 0.5 } } sphere{ center = {2, 1.5, 0}, radius = "
                      "0.3, material = material{ color = 0 , ior = 1} }"
                      "light{ type = 'point', position = {4, 3, 0} }"),
              Vec3(0));
}

TEST(ClosedForm, LambertUnderTheSun) {
  float expected = 0.5f / kPi * 3 * 0.8f;
  for (const char* angle : {"0", "0.53", "5"})
    expect_close(mean_of(kDown + settings("samples = 64") +
                         "plane{ size = 100, material = material{ color = 0.5, ior = 1 } } light{ type = 'sun', "
                         "direction = {0.6, 0.8, 0}, color = 3, angle = " +
                         angle + " }"),
                 Vec3(expected), 2e-3f);
}

TEST(ClosedForm, LambertUnderASphere) {
  // A sphere of radiance L and radius r at distance d straight above gives the irradiance pi L (r/d)^2.
  std::string scene =
      "camera{ from = {0.5, 1, 0}, to = {0, 0, 0}, fov = 0.01 } plane{ size = 100, material = material{ color = 0.5, "
      "ior = 1 } }"
      "sphere{ center = {0, 4, 0}, radius = 1, material = material{ color = 0, ior = 1, emission = 7 } }";
  float expected = 0.5f * 7 / 16;
  expect_close(mean_of(scene + settings("samples = 256")), Vec3(expected), 0.01f);
  expect_close(mean_of(scene + settings("samples = 256, integrator = 'whitted'")), Vec3(expected), 0.01f);
}

TEST(ClosedForm, LambertUnderASquare) {
  // Radiosity's form factor of a small surface under a parallel square of half side a at distance h, corner by corner.
  double a = 1, h = 2, x = a / h;
  double corner = 1 / (2 * M_PI) * 2 * (x / std::sqrt(1 + x * x)) * std::atan(x / std::sqrt(1 + x * x));
  float expected = float(0.5 * 7 * 4 * corner);
  for (const char* integrator : {"path", "whitted"})
    expect_close(mean_of("camera{ from = {0.5, 1, 0}, to = {0, 0, 0}, fov = 0.01 } plane{ size = 100, material = "
                         "material{ color = 0.5, ior = 1 } }"
                         "light{ type = 'area', center = {0, 2, 0}, color = 7 }" +
                         settings("samples = 256, integrator = '" + std::string(integrator) + "'")),
                 Vec3(expected), 0.02f);
}

TEST(ClosedForm, OneSidedLightsShineToOneSide) {
  std::string scene = "camera{ from = {0.5, 1, 0}, to = {0, 0, 0}, fov = 0.01 } plane{ size = 100 } light{ type = "
                      "'area', center = {0, 2, 0}, u = {0, 0, 1}, v = {1, 0, 0}, two_sided = ";
  EXPECT_EQ(mean_of(scene + "false }" + settings("samples = 8")), Vec3(0));
  EXPECT_GT(mean_of(scene + "true }" + settings("samples = 8")).x, 0.01f);
}

TEST(ClosedForm, EmissionIsSeenAsItIs) {
  std::string scene = kDown + "plane{ material = material{ emission = {1, 2, 3}, color = 0, ior = 1 } } light{ type = "
                              "'point', position = {0, 9, 0} }";
  for (const char* integrator : {"path", "whitted"})
    expect_close(mean_of(scene + settings("samples = 2, depth = 1, integrator = '" + std::string(integrator) + "'")),
                 Vec3(1, 2, 3), 1e-6f);
}

TEST(ClosedForm, MirrorsShowWhatIsBehindTheViewer) {
  // Straight down into a mirror, and up at a panel of radiance 5 that the camera stands below.
  std::string scene = "camera{ from = {0, 1, 0}, to = {0, 0, 0}, up = {0, 0, 1}, fov = 1 } plane{ material = material{ "
                      "color = 0, ior = 1, reflectance = {1, 0.5, 0.25} } }"
                      "rectangle{ center = {0, 2, 0}, material = material{ emission = 5, color = 0, ior = 1 } }";
  for (const char* integrator : {"path", "whitted"})
    expect_close(mean_of(scene + settings("samples = 256, depth = 2, integrator = '" + std::string(integrator) + "'")),
                 Vec3(5, 2.5f, 1.25f), 1e-3f);
}

TEST(ClosedForm, BeerAndLambert) {
  // Straight through a slab of index 1, 0.5 thick, to a white sky.
  std::string scene = "camera{ from = {0, 2, 0}, to = {0, 0, 0}, up = {0, 0, 1}, fov = 0.01 } light{ type = 'sky' } "
                      "box{ size = 0.5, material = material{ color = 1, roughness = 0, transmission = 1, ior = 1, "
                      "absorption = {0, 1, 4} } }";
  for (const char* integrator : {"path", "whitted"})
    expect_close(mean_of(scene + settings("samples = 4, integrator = '" + std::string(integrator) + "'")),
                 Vec3(1, std::exp(-0.5f), std::exp(-2.0f)), 1e-3f);
  // An index of 1.5 reflects 4 % on either side, again and again within: T = (1-R)^2 a / (1 - R^2 a^2).
  scene.replace(scene.find("ior = 1"), 7, "ior = 1.5");
  auto through = [](float absorption) {
    float a = std::exp(-0.5f * absorption), r = 0.04f;
    return (1 - r) * (1 - r) * a / (1 - r * r * a * a) + r + (1 - r) * (1 - r) * r * a * a / (1 - r * r * a * a);
  };
  expect_close(mean_of(scene + settings("samples = 1024, depth = 32")), Vec3(through(0), through(1), through(4)),
               0.01f);
}

TEST(ClosedForm, OpacityDividesLightAndShadow) {
  // Three sheets of opacity 0.25 above a diffuse floor under a point light, seen from below them.
  std::string scene = "camera{ from = {0.3, 0.5, 0}, to = {0, 0, 0}, fov = 0.01 } plane{ size = 100, material = "
                      "material{ color = 0.5, ior = 1 } } light{ type = 'point', position = {0, 4, 0}, color = 10 }"
                      "for i = 1, 3 do plane{ point = {0, i, 0}, material = material{ name = 'm' .. i, color = 0, ior "
                      "= 1, opacity = 0.25 } } end ";
  float lit = 0.5f / kPi * 10 / 16;
  for (const char* integrator : {"path", "whitted"})
    expect_close(mean_of(scene + settings("samples = 4, depth = 2, integrator = '" + std::string(integrator) + "'")),
                 Vec3(lit * 0.75f * 0.75f * 0.75f), 1e-3f);
  // And seen from above: through all of them, twice in all.
  std::string above = "camera{ from = {0.3, 3.5, 0}, to = {0, 0, 0}, fov = 0.01 }" + scene.substr(scene.find("plane"));
  expect_close(mean_of(above + settings("samples = 2048, depth = 2")), Vec3(lit * std::pow(0.75f, 6.0f)), 0.05f);
}

TEST(ClosedForm, PanesLetLightThrough) {
  // A thin pane of colour 0.5 between the light and the floor; straight up, 2 R / (1 + R) of it is reflected.
  std::string scene = "camera{ from = {0.1, 0.5, 0}, to = {0, 0, 0}, fov = 0.01 } plane{ size = 100, material = "
                      "material{ color = 0.5, ior = 1 } } light{ type = 'point', position = {0, 4, 0}, color = 10 }"
                      "rectangle{ center = {0, 2, 0}, u = {9, 0, 0}, v = {0, 0, 9}, material = material{ color = 0.5, "
                      "roughness = 0, transmission = 1, thin = true } }";
  expect_close(mean_of(scene + settings("samples = 16, depth = 2")),
               Vec3(0.5f / kPi * 10 / 16 * 0.5f * (1 - 0.08f / 1.04f)), 2e-3f);
}

const std::string kBusy = R"(
  camera{ from = {0, 2, 6}, to = {0, 0.7, 0} }
  render{ width = 90, height = 50, samples = 6, seed = 3 }
  plane{ material = material{ color = 0.6 } }
  sphere{ center = {-1, 0.8, 0}, radius = 0.8, material = material{ reflectance = 0.7 } }
  sphere{ center = {1, 0.8, 0}, radius = 0.8, material = material{ metallic = 1, roughness = 0.3, color = {0.9, 0.6, 0.2} } }
  box{ center = {0, 0.5, 2}, size = 0.5, rotate = {0, 30, 0} }
  light{ type = "sun" } light{ type = "sky" } light{ type = "area", center = {0, 4, 0} } light{ type = "point", position = {2, 3, 3} })";

TEST(Cracks, DoNotShowInClosedMeshes) {
  // From within a black sphere of many triangles under a white sky all is black. A material that light goes into,
  // anywhere in the scene, makes all of it watertight.
  testing::TemporaryFolder folder;
  std::string ball;
  constexpr int kSides = 60;
  for (int r = 0; r <= kSides; ++r)
    for (int s = 0; s < kSides; ++s) {
      float theta = kPi * float(r) / kSides, phi = 2 * kPi * float(s) / kSides, sine = std::sin(theta);
      if (r == kSides) sine = 0;
      ball += "v " + std::to_string(sine * std::cos(phi)) + " " + std::to_string(std::cos(theta)) + " " +
              std::to_string(sine * std::sin(phi)) + "\n";
    }
  for (int r = 0; r < kSides; ++r)
    for (int s = 0; s < kSides; ++s) {
      int a = r * kSides + s + 1, b = r * kSides + (s + 1) % kSides + 1;
      ball += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + kSides) + " " +
              std::to_string(a + kSides) + "\n";
    }
  folder.write("ball.obj", ball);
  for (const char* other : {"", "sphere{ radius = 0.1, material = material{ transmission = 1 } }"}) {
    std::string text = "camera{ from = {0.3, 0.1, 0.2}, to = {1, 0.2, 0.1}, fov = 120 } light{ type = 'sky' }\n"
                       "obj{ file = 'ball.obj', material = material{ color = 0, ior = 1 } } " +
                       std::string(other) + settings("samples = 1024");
    Folders folders = folder.folders();
    SceneReading reading = parse_lua_scene(folder / "scene.lua", text, folders);
    ASSERT_TRUE(reading.scene) << reading.error;
    testing::FixedShaders shaders;
    Preparation preparation = prepare(std::move(*reading.scene), shaders);
    ASSERT_TRUE(preparation.prepared) << preparation.error;
    EXPECT_EQ(preparation.prepared->geometry->watertight(), *other != 0);
    RenderProgress progress;
    RenderResult result = render(*preparation.prepared, {}, progress);
    size_t bright = 0;
    for (const Vec3& pixel : result.picture.pixels)
      bright += !is_black(pixel);
    EXPECT_LE(bright, *other ? 0u : 1u) << other;
  }
}

TEST(Determinism, AnyNumberOfThreadsGivesTheSameBits) {
  Picture one = render_text(kBusy, nullptr, {.threads = 1}).result.picture;
  for (unsigned threads : {2u, 3u, 7u}) {
    Rendering many = render_text(kBusy, nullptr, {.threads = threads});
    EXPECT_EQ(many.result.threads, threads);
    EXPECT_EQ(many.result.picture.pixels, one.pixels);
  }
  EXPECT_GT(mean(one).x, 0.1f);
}

TEST(Determinism, ACropIsAPartOfTheWhole) {
  Picture whole = render_text(kBusy).result.picture;
  Picture part = render_text(kBusy, nullptr, {.crop = Crop{17, 9, 40, 23}}).result.picture;
  ASSERT_EQ(part.width, 40);
  ASSERT_EQ(part.height, 23);
  for (int y = 0; y < 23; ++y)
    for (int x = 0; x < 40; ++x)
      ASSERT_EQ(part.at(x, y), whole.at(x + 17, y + 9)) << x << " " << y;
}

TEST(Determinism, TheSeedMatters) {
  std::string other = kBusy;
  other.replace(other.find("seed = 3"), 8, "seed = 4");
  EXPECT_NE(render_text(kBusy).result.picture.pixels, render_text(other).result.picture.pixels);
}

TEST(Interruption, DropsThePassInHand) {
  testing::TemporaryFolder folder;
  Folders folders = folder.folders();
  SceneReading reading =
      parse_lua_scene("s.lua", "render{ width = 256, height = 256, samples = 100000 } sphere{}", folders);
  testing::FixedShaders shaders;
  Preparation preparation = prepare(*reading.scene, shaders);
  ASSERT_TRUE(preparation.prepared) << preparation.error;
  RenderProgress progress;
  std::thread interrupter([&] {
    while (progress.samples_done == 0)
      std::this_thread::yield();
    progress.cancel = true;
  });
  RenderResult interrupted = render(*preparation.prepared, {}, progress);
  interrupter.join();
  EXPECT_TRUE(interrupted.interrupted);
  ASSERT_GT(interrupted.samples, 0u);
  // It is exactly the picture of that many samples.
  Scene again = *reading.scene;
  again.settings.samples = interrupted.samples;
  Preparation whole = prepare(again, shaders);
  RenderProgress unhindered;
  RenderResult result = render(*whole.prepared, {}, unhindered);
  EXPECT_FALSE(result.interrupted);
  EXPECT_EQ(result.picture.pixels, interrupted.picture.pixels);
}

TEST(Interruption, TimeEndsARender) {
  Rendering r =
      render_text("render{ width = 64, height = 64, samples = 1000000 } sphere{}", nullptr, {.seconds = 0.05});
  EXPECT_GT(r.result.samples, 0u);
  EXPECT_LT(r.result.samples, 1000000u);
  EXPECT_FALSE(r.result.interrupted);
}

std::shared_ptr<CppShader> shader() { return std::make_shared<CppShader>(); }
const std::string kShadedPlane = "plane{ size = 100, material = material{ shader = 'fake.lua', ior = 1 } } light{ type "
                                 "= 'sun', direction = {0, 1, 0}, color = 3.14159265, angle = 0 }";

TEST(Shaders, GetTheirInputsInBothPrecisions) {
  for (Precision precision : {Precision::F32, Precision::F64}) {
    auto s = shader();
    s->precision_ = precision;
    s->add(
        "color",
        {{"p", ValueType::Vec3}, {"id", ValueType::Integer}, {"n", ValueType::Vec3}, {"backface", ValueType::Boolean}},
        ValueType::Vec3, [](const double* in, double* out) {
          out[0] = 0.25 + 0.5 * in[3] + in[0] * 1e-3; // id of the plane: 0
          out[1] = in[5];                             // n.y
          out[2] = in[7] != 0 ? 0 : 0.5;
          return FaultCode::None;
        });
    expect_close(mean_of(kDown + settings("samples = 4") + kShadedPlane, s), Vec3(0.25f, 1, 0.5f), 1e-3f);
  }
}

TEST(Shaders, FaultsAreMagentaAndCounted) {
  auto s = shader();
  s->add("color", {{"p", ValueType::Vec3}}, ValueType::Vec3, [](const double*, double*) { return FaultCode::Index; });
  Rendering r = render_text(kDown + settings("samples = 4") + kShadedPlane, s);
  EXPECT_EQ(mean(r.result.picture), Vec3(1, 0, 1));
  EXPECT_EQ(r.result.fault_count, 8u * 8 * 4);
  ASSERT_EQ(r.result.faults.size(), 1u);
  const FaultKey& key = r.result.faults.begin()->first;
  EXPECT_EQ(key.file, "fake.lua");
  EXPECT_EQ(key.line, 7u);
  EXPECT_EQ(key.entry, "color");
  EXPECT_EQ(key.code, uint8_t(FaultCode::Index));
}

TEST(Shaders, ResultsThatAreNotFiniteAreFaultsToo) {
  for (double bad : {std::nan(""), double(INFINITY), -double(INFINITY)}) {
    auto s = shader();
    s->add("color", {}, ValueType::Vec3, [bad](const double*, double* out) { return out[1] = bad, FaultCode::None; });
    Rendering r = render_text(kDown + settings("samples = 1") + kShadedPlane, s);
    EXPECT_EQ(mean(r.result.picture), Vec3(1, 0, 1));
    ASSERT_EQ(r.result.faults.size(), 1u);
    EXPECT_EQ(r.result.faults.begin()->first.code, kNotFinite);
    EXPECT_EQ(r.result.faults.begin()->first.line, 2u); // where the function begins
  }
}

TEST(Shaders, FaultsSeenByOtherSurfacesAreBlack) {
  auto s = shader();
  s->add("emission", {}, ValueType::Vec3, [](const double*, double*) { return FaultCode::Error; });
  // A mirror below, the faulting panel above: its light is missing, nothing turns magenta.
  Vec3 value = mean_of("camera{ from = {0, 1, 0}, to = {0, 0, 0}, up = {0, 0, 1}, fov = 1 } plane{ material = "
                       "material{ color = 0, ior = 1, reflectance = 1 } }"
                       "rectangle{ center = {0, 2, 0}, material = material{ shader = 'fake.lua' } } light{ type = "
                       "'sky', intensity = 0 }" +
                           settings("samples = 4"),
                       s);
  EXPECT_EQ(value, Vec3(0));
}

TEST(Shaders, AFaultInHeightLeavesTheNormal) {
  auto s = shader();
  s->add("height", {{"p", ValueType::Vec3}}, ValueType::Number,
         [](const double*, double*) { return FaultCode::Error; });
  Rendering r = render_text(kDown + settings("samples = 1") + kShadedPlane, s);
  expect_close(mean(r.result.picture), Vec3(0.8f), 1e-3f);
  EXPECT_EQ(r.result.fault_count, 8u * 8 * 6);
}

TEST(Shaders, ValuesOutOfRangeAreKeptInRange) {
  auto s = shader();
  s->add("color", {}, ValueType::Vec3,
         [](const double*, double* out) { return out[0] = 7, out[1] = -3, out[2] = 0.5, FaultCode::None; });
  expect_close(mean_of(kDown + settings("samples = 1") + kShadedPlane, s), Vec3(1, 0, 0.5f), 1e-3f);
}

TEST(Shaders, ErrorsComeBeforeRendering) {
  EXPECT_THAT(render_text(kShadedPlane).error, HasSubstr("fake.lua:1:1: error: broken"));
  EXPECT_THAT(render_text(kShadedPlane).error, HasSubstr("the material 'material1' uses this shader"));
  auto wrong = shader();
  wrong->add("color", {}, ValueType::Number, {});
  EXPECT_THAT(render_text(kShadedPlane, wrong).error, HasSubstr("'color' gives no vec3"));
  auto volume = shader();
  volume->add("density", {{"n", ValueType::Vec3}}, ValueType::Number, {});
  EXPECT_THAT(render_text(kShadedPlane, volume).error,
              HasSubstr("'density' has an input that points of a volume do not"));
  auto none = shader();
  none->add("helper", {}, ValueType::Number, {});
  EXPECT_THAT(render_text(kShadedPlane, none).error, HasSubstr("none of the functions that a material uses"));
}

/// A shader whose surface glows in the colour of its bent normal, with height a * p.x.
std::shared_ptr<CppShader> slope_shader(double a) {
  auto s = shader();
  s->add("height", {{"p", ValueType::Vec3}}, ValueType::Number,
         [a](const double* in, double* out) { return out[0] = a * in[0], FaultCode::None; });
  s->add("emission", {{"n", ValueType::Vec3}}, ValueType::Vec3, [](const double* in, double* out) {
    for (int c = 0; c < 3; ++c)
      out[c] = 0.5 + 0.5 * in[c];
    return FaultCode::None;
  });
  return s;
}

TEST(Bump, FollowsTheDisplacedSurfaceUnderScaleAndMirroring) {
  // In object space the surface is y = a x; its tangent (1, a, 0) becomes (sx, a sy, 0), its normal (-a sy, sx, 0).
  constexpr float a = 0.5f;
  for (Vec3 scale : {Vec3(1), Vec3(1, 2, 3), Vec3(-1, 2, 3), Vec3(1, 1, -2)}) {
    std::string text = kDown + settings("samples = 1, depth = 1") +
                       "plane{ size = 10, material = material{ color = 0, ior = 1, shader = 'fake.lua' }, scale = {" +
                       std::to_string(scale.x) + ", " + std::to_string(scale.y) + ", " + std::to_string(scale.z) +
                       "} } light{ type = 'point', position = {0, 9, 0} }";
    Vec3 normal = mean_of(text, slope_shader(a)) * 2.0f - Vec3(1);
    Vec3 expected = glm::normalize(Vec3(-a * scale.y, scale.x, 0));
    if (expected.y < 0) expected = -expected;
    EXPECT_NEAR(glm::distance(normal, expected), 0, 2e-3f) << scale.x << " " << scale.y << " " << scale.z;
  }
}

TEST(Bump, BendsTheOtherWayFromInside) {
  // Seen from below, the viewer's normal is the negative of the outward bent one.
  std::string text = "camera{ from = {0, -1, 0}, to = {0, 0, 0}, up = {0, 0, 1}, fov = 0.01 }" +
                     settings("samples = 1, depth = 1") +
                     "plane{ size = 10, material = material{ color = 0, ior = 1, shader = 'fake.lua' } } light{ type = "
                     "'point', position = {0, 9, 0} }";
  Vec3 normal = mean_of(text, slope_shader(0.5)) * 2.0f - Vec3(1);
  EXPECT_NEAR(glm::distance(normal, -glm::normalize(Vec3(-0.5f, 1, 0))), 0, 2e-3f);
}

TEST(Bump, ThePapersWaySubtractsAUnitVector) {
  std::string text = kDown + settings("samples = 1, depth = 1") +
                     "plane{ size = 10, material = material{ color = 0, ior = 1, shader = 'fake.lua', bump = 'paper' } "
                     "} light{ type = 'point', position = {0, 9, 0} }";
  for (double a : {1e-2, 5.0}) { // however steep
    Vec3 normal = mean_of(text, slope_shader(a)) * 2.0f - Vec3(1);
    EXPECT_NEAR(glm::distance(normal, glm::normalize(Vec3(-1, 1, 0))), 0, 1e-2f);
  }
  Vec3 flat = mean_of(text, slope_shader(0)) * 2.0f - Vec3(1); // u = 0 leaves n
  EXPECT_NEAR(glm::distance(flat, Vec3(0, 1, 0)), 0, 1e-5f);
}

TEST(Bump, SteepSlopesStayAsBrightAsTheirColour) {
  // A plane whose height rises by 8 a unit, one way and the other, under a white sky: 0.8, and for a coat a little
  // more.
  for (const char* material : {"ior = 1", "ior = 1.5", "metallic = 1, roughness = 0.4"})
    for (double slope : {-8.0, 8.0, 2.0}) {
      Vec3 value = mean_of(
          "camera{ from = {0.5, 1, 0.2}, to = {0, 0, 0}, fov = 0.01 }" + settings("samples = 1024, depth = 2") +
              "plane{ size = 10, material = material{ " + material + ", shader = 'fake.lua' } } light{ type = 'sky' }",
          [&] {
            auto s = shader();
            s->add("height", {{"p", ValueType::Vec3}}, ValueType::Number,
                   [slope](const double* in, double* out) { return out[0] = slope * in[0], FaultCode::None; });
            return s;
          }());
      EXPECT_GT(value.x, 0.77f) << material << " " << slope;
      EXPECT_LT(value.x, std::string(material) == "ior = 1" ? 0.83f : 1.0f) << material << " " << slope;
    }
}

TEST(Bump, LeavesNoBlackSpotsOnMirrors) {
  // Strong waves on a mirror under a white sky: every reflection ends in the sky.
  auto s = shader();
  s->add("height", {{"p", ValueType::Vec3}}, ValueType::Number, [](const double* in, double* out) {
    return out[0] = 0.3 * std::sin(8 * in[0]) * std::cos(7 * in[2]), FaultCode::None;
  });
  Rendering r = render_text(
      "camera{ from = {0, 0.3, 6}, to = {0, 0, 0} } render{ width = 64, height = 32, samples = 8, depth = 64 }"
      "plane{ size = 50, material = material{ color = 0, ior = 1, reflectance = 1, shader = 'fake.lua' } } light{ type "
      "= 'sky' }",
      s);
  ASSERT_EQ(r.error, "");
  for (const Vec3& p : r.result.picture.pixels)
    EXPECT_NEAR(p.x, 1, 1e-4f);
}

TEST(FloatEnvironment, FlushesNothing) {
  DefaultFloatEnvironment environment;
  volatile float tiny = 1e-40f;
  EXPECT_GT(tiny * 0.5f, 0.0f);
}

} // namespace
} // namespace moonshade::renderer
