// Pictures through the real compiler and interpreter.
#include "renderer/render.h"
#include "renderer/scene/read_scene.h"
#include "renderer/test_support.h"

#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using ::testing::HasSubstr;

const std::string kScenes = MOONSHADE_TEST_SCENES "/";

struct Outcome {
  RenderResult result;
  std::string error, warnings;
};

Outcome render_file(const std::string& name, const ShaderOptions& shader_options = {}, const Overrides& overrides = {},
                    const RenderOptions& options = {}, const std::function<void(Scene&)>& change = {}) {
  SceneReading reading = read_scene(kScenes + name);
  if (!reading.scene) return {{}, reading.error, ""};
  if (change) change(*reading.scene);
  auto shaders = runtime_shaders(shader_options);
  Preparation preparation = prepare(std::move(*reading.scene), *shaders, overrides);
  if (!preparation.prepared) return {{}, preparation.error, preparation.warnings};
  RenderProgress progress;
  return {render(*preparation.prepared, options, progress), "", preparation.warnings};
}

/// The mean difference of two pictures, and the share of pixels that differ visibly.
std::pair<double, double> difference(const Picture& a, const Picture& b) {
  double sum = 0, visible = 0;
  for (size_t k = 0; k < a.pixels.size(); ++k) {
    float apart = max_component(glm::abs(a.pixels[k] - b.pixels[k]));
    sum += apart;
    visible += apart > 0.01f;
  }
  return {sum / double(a.pixels.size()), visible / double(a.pixels.size())};
}

TEST(Images, CompiledAndInterpretedShadersGiveOnePicture) {
  for (IntegratorKind integrator : {IntegratorKind::Path, IntegratorKind::Whitted}) {
    auto change = [&](Scene& scene) { scene.settings.integrator = integrator; };
    Outcome jit = render_file("bumpy.scene.lua", {}, {}, {}, change);
    Outcome interp = render_file("bumpy.scene.lua", {.backend = Backend::Interp}, {}, {}, change);
    ASSERT_EQ(jit.error + interp.error, "");
    auto [mean, visible] = difference(jit.result.picture, interp.result.picture);
    // Rounding may send a path another way now and then; never many of them.
    EXPECT_LT(mean, 1e-3);
    EXPECT_LT(visible, 0.01);
    EXPECT_EQ(jit.result.fault_count, 0u);
  }
}

TEST(Images, DoublePrecisionIsTheInterpretersPicture) {
  // The interpreter has no exact gradients.
  auto differences = [](Scene& scene) {
    for (Material& material : scene.materials)
      material.bump = BumpMode::Differences;
  };
  Outcome wide = render_file("bumpy.scene.lua", {.precision = Precision::F64}, {}, {}, differences);
  Outcome interp = render_file("bumpy.scene.lua", {.backend = Backend::Interp}, {}, {}, differences);
  ASSERT_EQ(wide.error + interp.error, "");
  EXPECT_EQ(wide.result.picture.pixels, interp.result.picture.pixels); // bit for bit
}

TEST(Images, EveryWidthGivesTheSameBits) {
  Outcome best = render_file("bumpy.scene.lua");
  for (unsigned width : kWidths) {
    Outcome other = render_file("bumpy.scene.lua", {.width = width});
    ASSERT_EQ(other.error, "");
    EXPECT_EQ(other.result.picture.pixels, best.result.picture.pixels) << width;
  }
}

TEST(Images, ThreadsChangeNothing) {
  Outcome one = render_file("bumpy.scene.lua", {}, {}, {.threads = 1});
  for (unsigned threads : {2u, 3u})
    EXPECT_EQ(render_file("bumpy.scene.lua", {}, {}, {.threads = threads}).result.picture.pixels,
              one.result.picture.pixels);
}

TEST(Images, EveryIntegratorKeepsItsBits) {
  // Of paths and photons that are carried together, and of lanes.
  struct Split {
    size_t batch_paths;
    unsigned width;
  };
  for (const char* scene : {"diffuse.scene.lua", "bumpy.scene.lua", "lights.scene.lua", "volumes.scene.lua"})
    for (IntegratorKind integrator :
         {IntegratorKind::Path, IntegratorKind::Whitted, IntegratorKind::Sppm, IntegratorKind::Irradiance}) {
      auto change = [&](Scene& s) { s.settings.integrator = integrator, s.settings.photons = 5000; };
      Outcome best = render_file(scene, {}, {}, {}, change);
      ASSERT_EQ(best.error, "");
      for (Split split : {Split{256, 0}, Split{600, 4}, Split{5000, 1}})
        EXPECT_EQ(render_file(scene, {.width = split.width}, {}, {.batch_paths = split.batch_paths}, change)
                      .result.picture.pixels,
                  best.result.picture.pixels)
            << scene << ", integrator " << int(integrator) << ", batch " << split.batch_paths << ", width "
            << split.width;
    }
}

TEST(Images, LightsAndTransparentSurfacesGiveTheSameBitsToo) {
  for (IntegratorKind integrator :
       {IntegratorKind::Path, IntegratorKind::Whitted, IntegratorKind::Sppm, IntegratorKind::Irradiance}) {
    auto change = [&](Scene& scene) { scene.settings.integrator = integrator, scene.settings.photons = 5000; };
    Outcome one = render_file("lights.scene.lua", {.width = 1}, {}, {.threads = 1}, change);
    ASSERT_EQ(one.error, "");
    EXPECT_EQ(one.result.fault_count, 0u);
    for (unsigned width : {4u, 16u})
      for (unsigned threads : {2u, 3u})
        EXPECT_EQ(
            render_file("lights.scene.lua", {.width = width}, {}, {.threads = threads}, change).result.picture.pixels,
            one.result.picture.pixels)
            << width << " lanes, " << threads << " threads";
  }
}

TEST(Images, VolumesGiveTheSameBitsToo) {
  for (IntegratorKind integrator :
       {IntegratorKind::Path, IntegratorKind::Whitted, IntegratorKind::Sppm, IntegratorKind::Irradiance}) {
    auto change = [&](Scene& scene) { scene.settings.integrator = integrator, scene.settings.photons = 5000; };
    Outcome one = render_file("volumes.scene.lua", {.width = 1}, {}, {.threads = 1}, change);
    ASSERT_EQ(one.error, "");
    EXPECT_EQ(one.result.fault_count, 0u);
    for (unsigned width : {4u, 16u})
      EXPECT_EQ(render_file("volumes.scene.lua", {.width = width}, {}, {.threads = width / 4 + 1}, change)
                    .result.picture.pixels,
                one.result.picture.pixels)
          << width << " lanes";
  }
}

TEST(Images, ParametersReachTheShader) {
  Outcome plain = render_file("bumpy.scene.lua");
  Outcome other = render_file("bumpy.scene.lua", {}, {{"bumpy", {{"tint", "0.1,0.9,0.1"}}}});
  ASSERT_EQ(other.error, "");
  EXPECT_NE(plain.result.picture.pixels, other.result.picture.pixels);
}

TEST(Images, WrongParametersAreNamed) {
  EXPECT_THAT(render_file("bumpy.scene.lua", {}, {{"bumpy", {{"tnit", "1"}}}}).error,
              HasSubstr("no parameter 'tnit'; did you mean 'tint'?"));
  EXPECT_THAT(render_file("bumpy.scene.lua", {}, {{"bumpy", {{"scale", "100"}}}}).error, HasSubstr("scale"));
  EXPECT_THAT(render_file("bumpy.scene.lua", {}, {{"bumpyy", {{"scale", "1"}}}}).error,
              HasSubstr("no material 'bumpyy'; did you mean 'bumpy'?"));
}

TEST(Images, TheThreeStatementsOfMtlWork) {
  auto change = [](Scene& scene) {
    Settings& s = scene.settings;
    s.width = 64, s.height = 48, s.samples = 4;
  };
  Outcome jit = render_file("strange.obj", {}, {}, {}, change);
  Outcome interp = render_file("strange.obj", {.backend = Backend::Interp}, {}, {}, change);
  ASSERT_EQ(jit.error + interp.error, "");
  EXPECT_LT(difference(jit.result.picture, interp.result.picture).first, 1e-3);
}

TEST(Images, FaultsAreMagentaAndNamed) {
  Outcome r = render_file("faulty.scene.lua");
  ASSERT_EQ(r.error, "");
  size_t magenta = 0;
  for (const Vec3& p : r.result.picture.pixels)
    magenta += p == Vec3(1, 0, 1);
  EXPECT_GT(magenta, 10u);
  EXPECT_LT(magenta, r.result.picture.pixels.size() - 10);
  ASSERT_GE(r.result.faults.size(), 1u);
  const FaultKey& key = r.result.faults.begin()->first;
  EXPECT_EQ(key.file, kScenes + "faulty.lua");
  EXPECT_TRUE((key.line == 3 && key.message == "past the last shade") ||
              (key.line == 4 && key.code == uint8_t(FaultCode::DivideByZero)))
      << key.line << key.message;
}

TEST(Images, BrokenShadersAreErrorsBeforeRendering) {
  std::string error = render_file("broken.scene.lua").error;
  EXPECT_THAT(error, HasSubstr("broken.lua:2:"));
  EXPECT_THAT(error, HasSubstr("error: "));
  EXPECT_THAT(error, HasSubstr("broken.scene.lua:1: note: the material 'broken' uses this shader"));
}

} // namespace
} // namespace moonshade::renderer
