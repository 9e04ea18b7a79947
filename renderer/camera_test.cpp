// Cameras against geometry by hand.
#include "renderer/camera.h"

#include "renderer/sampling/sampler.h"
#include "renderer/test_support.h"

namespace moonshade::renderer {
namespace {

using testing::render_text;
using testing::Rendering;

Camera at_origin() {
  Camera camera;
  camera.from = Vec3(0), camera.to = Vec3(0, 0, -5);
  return camera;
}

TEST(Camera, PerspectiveSpansItsAngle) {
  Camera camera = at_origin();
  camera.fov = 90;
  CameraRays rays(camera, 200, 100);
  Vec3 corner = rays.ray(0, 0).direction, center = rays.ray(100, 50).direction;
  EXPECT_NEAR(corner.y / -corner.z, 1, 1e-5f);
  EXPECT_NEAR(corner.x / corner.z, 2, 1e-5f);
  EXPECT_NEAR(center.z, -1, 1e-6f);
  EXPECT_NEAR(rays.spread(), 2.0f / 100, 1e-6f);
  EXPECT_EQ(rays.width(), 0);
}

TEST(Camera, OrthographicRaysAreParallelAndAPixelApart) {
  Camera camera = at_origin();
  camera.kind = CameraKind::Orthographic;
  camera.height = 4;
  CameraRays rays(camera, 200, 100);
  EXPECT_EQ(rays.ray(0, 0).direction, Vec3(0, 0, -1));
  EXPECT_NEAR(rays.ray(0, 0).origin.x, -4, 1e-5f);
  EXPECT_NEAR(rays.ray(0, 0).origin.y, 2, 1e-5f);
  EXPECT_NEAR(rays.ray(201, 100).origin.x, 4.04f, 1e-5f);
  EXPECT_NEAR(rays.width(), 0.04f, 1e-6f);
  EXPECT_EQ(rays.spread(), 0);
  EXPECT_NEAR(rays.depth(Vec3(7, 7, -3)), 3, 1e-6f);
}

TEST(Camera, LensRaysMeetOnThePlaneInFocus) {
  Camera camera = at_origin();
  camera.aperture = 0.5f;
  camera.focus = 3;
  CameraRays rays(camera, 100, 100);
  Ray middle = rays.ray(80, 20);
  Vec3 meeting = middle.origin + middle.direction * (3 / -middle.direction.z);
  float widest = 0;
  for (uint32_t k = 0; k < 64; ++k) {
    Ray ray = rays.ray(80, 20, Vec2(unit_float(hash32(k)), unit_float(hash32(~k))));
    Vec3 there = ray.origin + ray.direction * ((3 + ray.origin.z) / -ray.direction.z);
    EXPECT_LT(glm::distance(there, meeting), 1e-5f);
    EXPECT_NEAR(ray.origin.z, 0, 1e-6f);
    widest = std::max(widest, glm::length(ray.origin));
  }
  EXPECT_GT(widest, 0.2f);
  EXPECT_LE(widest, 0.25f);
  camera.focus = 0; // that of `to`
  Ray through = CameraRays(camera, 100, 100).ray(50, 50, Vec2(0.9f, 0.1f));
  Vec3 there = through.origin + through.direction * (5 / -through.direction.z);
  EXPECT_LT(glm::length(Vec2(there)), 1e-5f);
}

TEST(Camera, ALensBlursWhatIsOutOfFocus) {
  auto contrast = [](const std::string& lens) {
    // A white half plane before black surroundings, its edge in the middle: how steep is it?
    Rendering r =
        render_text("camera{ from = {0, 0, 4}, to = {0, 0, 0}, fov = 3" + lens +
                    " } render{ width = 64, height = 8, samples = 64 } rectangle{ center = {5, 0, 0}, u = {5, "
                    "0, 0}, v = {0, 5, 0}, material = material{ emission = 1, color = 0, ior = 1 } }");
    EXPECT_EQ(r.error, "");
    return r.result.picture.at(34, 4).x - r.result.picture.at(29, 4).x;
  };
  EXPECT_GT(contrast(""), 0.99f);
  EXPECT_GT(contrast(", aperture = 1"), 0.99f); // `to` is in focus
  EXPECT_LT(contrast(", aperture = 1, focus = 2"), 0.5f);
}

} // namespace
} // namespace moonshade::renderer
