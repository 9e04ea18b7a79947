// Bump mapping with compiled shaders: spheres whose displaced normal is known in closed form, under scale and
// mirroring.
#include "renderer/test_support.h"

#include "runtime/allowed_folders.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <sstream>

namespace moonshade::renderer {
namespace {

using testing::TemporaryFolder;

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(9);
  out << "{" << v.x << "," << v.y << "," << v.z << "}";
  return out.str();
}

/// An image whose red grows with u from 0 to 1, linearly, and whose green falls with v.
void write_ramp(const std::string& path) {
  constexpr int kSide = 64;
  std::vector<float> texels;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      texels.insert(texels.end(), {(float(x) + 0.5f) / kSide, (float(y) + 0.5f) / kSide, 0});
  const auto output = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(output && output->open(path, OIIO::ImageSpec(kSide, kSide, 3, OIIO::TypeFloat)));
  ASSERT_TRUE(output->write_image(OIIO::TypeFloat, texels.data()) && output->close());
}

/// The bent normal at the point M u of the unit sphere, seen from straight above it, as the shader of that surface sees
/// it. `shader` gives height.
Vec3 rendered_normal(const std::string& shader, const Vec3& u, const Vec3& scale, const std::string& bump,
                     bool from_inside = false, ShaderOptions options = {}) {
  Vec3 point = u * scale, normal = glm::normalize(u / scale) * (from_inside ? -0.2f : 1.0f);
  TemporaryFolder folder;
  folder.write("bumpy.lua", shader + "\nfunction emission(n) return n * 0.5 + 0.5 end\n");
  write_ramp(folder / "ramp.exr");
  options.folders = {folder_of(folder / "scene.lua")};
  Folders folders = folder.folders();
  std::string scene = "camera{ from = " + text(point + normal) + ", to = " + text(point) +
                      ", fov = 0.01 } render{ width = 4, height = 4, samples = 1, depth = 1 }"
                      "sphere{ radius = 1, scale = " +
                      text(scale) + ", material = material{ color = 0, ior = 1, shader = 'bumpy.lua', bump = '" + bump +
                      "' } } light{ type = 'point', position = {0, 9, 0} }";
  SceneReading reading = parse_lua_scene(folder / "scene.lua", scene, folders);
  EXPECT_EQ(reading.error, "");
  if (!reading.scene) return Vec3(0);
  auto shaders = runtime_shaders(options);
  Preparation preparation = prepare(std::move(*reading.scene), *shaders);
  EXPECT_EQ(preparation.error, "");
  if (!preparation.prepared) return Vec3(0);
  RenderProgress progress;
  Picture picture = render(*preparation.prepared, {}, progress).picture;
  return picture.pixels[5] * 2.0f - Vec3(1);
}

/// n' = normalize(M^-T normalize(u - (g - (g.u) u))), g the gradient of height by p.
Vec3 expected_normal(const Vec3& u, const Vec3& scale, const Vec3& g) {
  Vec3 local = glm::normalize(u - (g - u * glm::dot(g, u)));
  return glm::normalize(local / scale);
}

const Vec3 kPoint = glm::normalize(Vec3(0.4f, 0.5f, 0.7f));
const Vec3 kScales[] = {Vec3(1), Vec3(1, 2, 3), Vec3(-1, 2, 3), Vec3(1, -1, 1)};

void expect_near(const Vec3& actual, const Vec3& expected, float tolerance) {
  EXPECT_NEAR(glm::distance(actual, expected), 0, tolerance) << text(actual) << " instead of " << text(expected);
}

/// The shader's height has the gradient g at kPoint: every way to bend finds it, under every scale.
void expect_bent(const std::string& shader, const Vec3& g, float tolerance_of_differences) {
  for (const Vec3& scale : kScales) {
    const Vec3 expected = expected_normal(kPoint, scale, g);
    expect_near(rendered_normal(shader, kPoint, scale, "gradient"), expected, 2e-4f);
    expect_near(rendered_normal(shader, kPoint, scale, "differences"), expected, 5e-3f);
    expect_near(rendered_normal(shader, kPoint, scale, "gradient", false, {.backend = Backend::Interp}), expected,
                tolerance_of_differences);
    expect_near(rendered_normal(shader, kPoint, scale, "gradient", false, {.precision = Precision::F64}), expected,
                2e-4f);
    // From inside the viewer's normal is the negative of the outward one.
    expect_near(rendered_normal(shader, kPoint, scale, "gradient", true), -expected, 2e-4f);
  }
}

TEST(BumpGradient, FollowsADisplacedSphereUnderScaleAndMirroring) {
  // h = 0.1 sin(9 x) + 0.3 y z
  expect_bent("function height(p) return 0.1 * sin(9 * p.x) + 0.3 * p.y * p.z end",
              Vec3(0.9f * std::cos(9 * kPoint.x), 0.3f * kPoint.z, 0.3f * kPoint.y), 5e-4f);
}

TEST(BumpGradient, FollowsAnImage) {
  expect_bent("function height(p, fw) local t = texture('ramp.exr', p.xy * 0.25 + 0.5, fw) return t.x - 0.5 * t.y end",
              Vec3(0.25f, 0.125f, 0), 5e-3f); // v goes up
}

TEST(BumpGradient, IsTotalInP) {
  // h = 0.2 P.x P.y: by p through P = M p.
  for (const Vec3& scale : kScales) {
    const Vec3 world = kPoint * scale;
    const Vec3 g = Vec3(0.2f * world.y, 0.2f * world.x, 0) * scale;
    expect_near(rendered_normal("function height(P) return 0.2 * P.x * P.y end", kPoint, scale, "gradient"),
                expected_normal(kPoint, scale, g), 2e-4f);
    const Vec3 both = g + Vec3(0, 0, 0.5f);
    expect_near(
        rendered_normal("function height(P, p) return 0.2 * P.x * P.y + p.z / 2 end", kPoint, scale, "gradient"),
        expected_normal(kPoint, scale, both), 2e-4f);
  }
}

TEST(BumpGradient, IsTotalInUv) {
  // u is the longitude, so along the surface u' = (-z, 0, x) / (2 pi (x^2 + z^2)); v' = the latitude's.
  const float square = kPoint.x * kPoint.x + kPoint.z * kPoint.z, pi = 3.14159265f;
  const Vec3 by_u = Vec3(-kPoint.z, 0, kPoint.x) / (2 * pi * square);
  const Vec3 by_v = Vec3(0, 1, 0) / (pi * std::sqrt(1 - kPoint.y * kPoint.y));
  for (const Vec3& scale : kScales) {
    expect_near(rendered_normal("function height(uv) return 2 * uv.x end", kPoint, scale, "gradient"),
                expected_normal(kPoint, scale, by_u * 2.0f), 2e-4f);
    expect_near(
        rendered_normal("function height(uv, p) return 0.3 * uv.y - uv.x + 0.2 * p.x end", kPoint, scale, "gradient"),
        expected_normal(kPoint, scale, by_v * 0.3f - by_u + Vec3(0.2f, 0, 0)), 2e-4f);
  }
}

TEST(BumpGradient, OfNoGradientLeavesTheNormal) {
  expect_near(rendered_normal("function height(p) return floor(p.x * 9) end", kPoint, Vec3(1), "gradient"), kPoint,
              2e-4f);
  expect_near(rendered_normal("function height(time) return time end", kPoint, Vec3(1), "gradient"), kPoint, 2e-4f);
}

TEST(BumpGradient, OfAFaultLeavesTheNormal) {
  expect_near(rendered_normal("function height(p) assert(p.x > 9, 'no'); return p.x end", kPoint, Vec3(1), "gradient"),
              kPoint, 2e-4f);
}

} // namespace
} // namespace moonshade::renderer
