#include "renderer/geometry/geometry.h"

#include "renderer/sampling/sampler.h"
#include "renderer/sampling/warp.h"
#include "renderer/test_support.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace moonshade::renderer {
namespace {

struct World {
  Scene scene;
  std::unique_ptr<Geometry> geometry;

  explicit World(const std::string& text, bool watertight = true) {
    SceneReading reading = parse_lua_scene("s.lua", text, Folders());
    if (!reading.scene) {
      ADD_FAILURE() << reading.error;
      return;
    }
    scene = std::move(*reading.scene);
    std::string error;
    geometry = Geometry::build(scene, error, {}, watertight);
    EXPECT_EQ(error, "");
  }
  std::optional<SurfacePoint> meet(const Vec3& from, const Vec3& towards) const {
    Ray ray{from, 0, glm::normalize(towards - from), kInfinity};
    Hit hit;
    geometry->closest({&ray, 1}, &hit);
    return hit.found() ? std::optional(geometry->surface(ray, hit)) : std::nullopt;
  }
  /// Where something must be there.
  SurfacePoint point(const Vec3& from, const Vec3& towards) const {
    std::optional<SurfacePoint> met = meet(from, towards);
    EXPECT_TRUE(met.has_value());
    return met.value_or(SurfacePoint{});
  }
};

Vec3 direction(uint32_t k) {
  Vec2 u = Sampler(1, k, 0).two(0);
  float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
}

TEST(Geometry, SpheresAreMetWhereTheyAre) {
  World world("sphere{ center = {1, 2, 3}, radius = 0.5, scale = {1, 2, 1} }"); // scale moves the centre, too
  SurfacePoint point = world.point({10, 4, 3}, {1, 4, 3});
  EXPECT_NEAR(point.world.x, 1.5f, 1e-5f);
  EXPECT_NEAR(point.local.x, 0.5f, 1e-5f); // measured from the centre, in the sphere's own units
  EXPECT_NEAR(point.distance, 8.5f, 1e-5f);
  EXPECT_NEAR(glm::distance(point.geometric_normal, Vec3(1, 0, 0)), 0, 1e-5f);
  EXPECT_FALSE(world.meet({10, 5.1f, 3}, {1, 5.1f, 3}));
  // From inside, the far side; the normal still points outward.
  point = world.point({1, 4, 3}, {9, 4, 3});
  EXPECT_NEAR(point.world.x, 1.5f, 1e-5f);
  EXPECT_GT(point.geometric_normal.x, 0.99f);
}

TEST(Geometry, DerivativesAreThoseOfThePoint) {
  // P(uv + d) - P(uv) against dpdu * d.x + dpdv * d.y, over pairs of neighbouring hits.
  for (const char* text : {"sphere{ radius = 2, rotate = {20, 30, 40}, scale = {1, 1.5, 0.7} }",
                           "rectangle{ u = {2, 0, 1}, v = {0, 3, -1}, rotate = {10, 20, 30} }",
                           "box{ size = {1, 2, 3}, scale = {-1, 1, 1} }"}) {
    World world(text);
    int compared = 0;
    for (uint32_t k = 0; k < 200; ++k) {
      Vec3 from = direction(k) * 20.0f, towards = direction(k + 1000) * 0.5f;
      auto a = world.meet(from, towards), b = world.meet(from, towards + direction(k + 5000) * 1e-3f);
      if (!a || !b || glm::dot(a->geometric_normal, b->geometric_normal) < 0.999f || glm::distance(a->uv, b->uv) > 0.1f)
        continue;
      // Near the poles u runs fast and the difference is no derivative.
      if (a->uv.y > 0.9f || a->uv.y < 0.1f) continue;
      Vec2 d = b->uv - a->uv;
      Vec3 expected = b->world - a->world;
      EXPECT_LT(glm::distance(a->dpdu * d.x + a->dpdv * d.y, expected), 0.05f * glm::length(expected) + 1e-5f) << text;
      ++compared;
    }
    EXPECT_GT(compared, 40) << text;
  }
}

/// Rays that start from points of the surface, out of it.
void expect_no_shadow_of_itself(const std::string& text, bool watertight) {
  World world(text, watertight);
  Vec3 center = world.geometry->bounds().center();
  float reach = world.geometry->bounds().radius();
  int met = 0;
  for (uint32_t k = 0; k < 2000; ++k) {
    auto point = world.meet(center + direction(k) * (3 * reach), center + direction(k + 10000) * (0.3f * reach));
    if (!point) continue;
    ++met;
    Vec3 up = point->geometric_normal;
    Vec3 viewer = direction(k);
    if (glm::dot(up, viewer) < 0) up = -up;
    if (text.find("plane") == std::string::npos) up = point->geometric_normal;
    Vec3 out = Frame(up).to_world(sample_cosine_hemisphere(Sampler(2, k, 0).two(1)));
    Ray next{point->world + up * point->offset, 0, out, kInfinity};
    uint8_t blocked = 0;
    world.geometry->occluded({&next, 1}, &blocked);
    EXPECT_FALSE(blocked) << text << " " << k;
  }
  EXPECT_GT(met, 20) << text; // rays seldom meet the thin one
}

TEST(Geometry, SurfacesDoNotShadowThemselves) {
  for (bool watertight : {true, false})
    for (const char* text :
         {"sphere{ radius = 0.5 }", "sphere{ radius = 1000 }", "sphere{ center = {5000, -3000, 100}, radius = 0.5 }",
          "sphere{ radius = 1, scale = {1, 100, 0.1}, translate = {50, 0, 0} }",
          "plane{ size = 2000, normal = {1, 2, 3} }",
          "box{ size = 1, translate = {10000, 0, 0}, rotate = {10, 20, 30} }",
          "box{ size = 0.001, rotate = {10, 20, 30} }"})
      expect_no_shadow_of_itself(text, watertight);
}

TEST(Geometry, MirroredMeshesKeepTheirOutside) {
  for (const char* text : {"box{}", "box{ scale = {-1, 1, 1} }", "box{ scale = {-1, -1, -1} }"}) {
    World world(text);
    SurfacePoint point = world.point({5, 0.1f, 0.2f}, {0, 0.1f, 0.2f});
    EXPECT_GT(point.geometric_normal.x, 0.99f) << text;
    EXPECT_GT(point.shading_normal.x, 0.99f) << text;
  }
}

TEST(Geometry, ShadowRaysEndAtTheirEnd) {
  World world("sphere{ center = {0, 0, 10} }");
  Ray shorter{{0, 0, 0}, 0, {0, 0, 1}, 8.9f}, longer{{0, 0, 0}, 0, {0, 0, 1}, 9.1f};
  Ray rays[2] = {shorter, longer};
  uint8_t blocked[2];
  world.geometry->occluded(rays, blocked);
  EXPECT_FALSE(blocked[0]);
  EXPECT_TRUE(blocked[1]);
}

/// A bumpy ball of some thousand triangles, closed to the bit.
std::shared_ptr<const Mesh> ball() {
  auto mesh = std::make_shared<Mesh>();
  constexpr uint32_t kRings = 40, kSides = 40;
  for (uint32_t r = 0; r <= kRings; ++r)
    for (uint32_t s = 0; s <= kSides; ++s) {
      float theta = kPi * float(r) / kRings, phi = 2 * kPi * float(s % kSides) / kSides;
      float radius = 1 + 0.1f * std::sin(7 * theta) * std::cos(5 * phi), sine = r % kRings ? std::sin(theta) : 0.0f;
      if (sine == 0) radius = 1;
      mesh->positions.push_back(radius * Vec3(sine * std::cos(phi), std::cos(theta), sine * std::sin(phi)));
    }
  for (uint32_t r = 0; r < kRings; ++r)
    for (uint32_t s = 0; s < kSides; ++s) {
      uint32_t a = r * (kSides + 1) + s, b = a + kSides + 1;
      if (r > 0) mesh->triangles.push_back({a, a + 1, b});
      if (r + 1 < kRings) mesh->triangles.push_back({a + 1, b + 1, b});
    }
  return mesh;
}

TEST(Geometry, NothingSlipsThroughEdges) {
  // From within a closed ball, at its edges and anywhere: watertight, every ray meets it; else nearly every one.
  Scene scene;
  Object object;
  object.mesh = ball();
  object.materials = {0};
  scene.objects.push_back(object);
  std::string error;
  auto tight = Geometry::build(scene, error, {}, true), quick = Geometry::build(scene, error, {}, false);
  ASSERT_TRUE(tight && quick) << error;
  constexpr uint32_t kRays = 200'000;
  uint32_t out_of_tight = 0, out_of_quick = 0;
  for (uint32_t k = 0; k < kRays; ++k) {
    const Mesh::Corners& corners = object.mesh->triangles[hash32(k) % object.mesh->triangles.size()];
    const Vec3 &a = object.mesh->positions[corners[k % 3]], &b = object.mesh->positions[corners[(k + 1) % 3]];
    Vec3 from = direction(k) * 0.4f, at_edge = a + (b - a) * (0.1f + 0.8f * unit_float(hash32(k + 1)));
    Ray edge{from, 0, glm::normalize(at_edge - from), kInfinity}, any{from, 0, direction(k + kRays), kInfinity};
    Hit met[2];
    Ray rays[2] = {edge, any};
    tight->closest(rays, met);
    out_of_tight += !met[0].found() + !met[1].found();
    quick->closest({&any, 1}, met);
    out_of_quick += !met[0].found();
  }
  EXPECT_EQ(out_of_tight, 0u);
  EXPECT_LE(out_of_quick, 2u);
}

TEST(Geometry, InstancesAreMetAsIfEachWereAMeshOfItsOwn) {
  auto shared = ball();
  ASSERT_GE(shared->triangles.size(), Geometry::kInstancedTriangles);
  Scene once, apart;
  for (int k = 0; k < 3; ++k) {
    Object object;
    object.mesh = shared;
    object.materials = {uint32_t(k)};
    object.to_world = glm::translate(Mat4(1.0f), Vec3(3.0f * float(k), 0, 0)) *
                      glm::rotate(Mat4(1.0f), float(k), Vec3(1, 2, 3)) *
                      glm::scale(Mat4(1.0f), Vec3(1, k == 2 ? -2 : 1, 0.5f));
    once.objects.push_back(object);
    object.mesh = ball();
    apart.objects.push_back(object);
  }
  std::string error;
  // Shadow rays pass through the second one.
  auto a = Geometry::build(once, error, {0, 1, 0}), b = Geometry::build(apart, error, {0, 1, 0});
  ASSERT_TRUE(a && b) << error;
  EXPECT_TRUE(a->objects()[0].vertices.kept().empty());
  EXPECT_FALSE(b->objects()[0].vertices.kept().empty());
  size_t found = 0, different = 0, behind = 0;
  for (uint32_t k = 0; k < 20000; ++k) {
    auto random = [&](uint32_t d) { return unit_float(hash_combine(k, d)); };
    Ray ray{Vec3(-2 + 10 * random(0), 4, -2 + 4 * random(1)), 0, Vec3(0), kInfinity};
    ray.direction = glm::normalize(Vec3(-2 + 10 * random(2), -2, -2 + 4 * random(3)) - ray.origin);
    Hit hit_a, hit_b;
    a->closest({&ray, 1}, &hit_a);
    b->closest({&ray, 1}, &hit_b);
    uint8_t blocked_a, blocked_b;
    a->occluded({&ray, 1}, &blocked_a);
    b->occluded({&ray, 1}, &blocked_b);
    different += hit_a.object != hit_b.object || hit_a.primitive != hit_b.primitive || blocked_a != blocked_b;
    if (!hit_a.found() || hit_a.object != hit_b.object || hit_a.primitive != hit_b.primitive) continue;
    ++found;
    SurfacePoint p = a->surface(ray, hit_a), q = b->surface(ray, hit_b);
    EXPECT_EQ(p.world, q.world); // not by Embree: the same bits
    EXPECT_EQ(p.geometric_normal, q.geometric_normal);
    EXPECT_EQ(p.local, q.local);
    // The next ray does not meet the surface that it leaves.
    Ray next{p.world + p.geometric_normal * p.offset, 0, p.geometric_normal, 1e-2f};
    if (glm::dot(p.geometric_normal, ray.direction) > 0)
      next.direction = p.geometric_normal * -1.0f, next.origin = p.world - p.geometric_normal * p.offset;
    Hit again;
    a->closest({&next, 1}, &again);
    behind += again.found() && again.object == hit_a.object && again.primitive == hit_a.primitive;
  }
  EXPECT_GT(found, 5000u);
  EXPECT_LT(different, 10u); // rays along edges
  EXPECT_EQ(behind, 0u);
}

} // namespace
} // namespace moonshade::renderer
