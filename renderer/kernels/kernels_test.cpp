// Kernels give what the code for one point gives, on every instruction set the same bits.
#include "renderer/kernels/kernels.h"

#include "renderer/materials/bsdf.h"
#include "renderer/materials/channels.h"
#include "renderer/scene/shapes.h"
#include "renderer/test_support.h"

#include <cmath>
#include <cstring>

namespace moonshade::renderer {
namespace {

float number(uint32_t a, uint32_t b) { return Sampler(3, a, b).one(0); }
Vec3 direction(uint32_t a, uint32_t b) {
  Vec3 v = Vec3(number(a, 3 * b), number(a, 3 * b + 1), number(a, 3 * b + 2)) * 2.0f - Vec3(1);
  return normalize_or(v, Vec3(0, 0, 1));
}
void set(LaneFloats (&lanes)[3], size_t lane, const Vec3& v) {
  for (int c = 0; c < 3; ++c)
    lanes[c][lane] = v[c];
}

/// Points with normals a little apart, a triangle or a sky as light.
ScatterBlock some_block(uint32_t seed) {
  ScatterBlock b{};
  for (uint32_t i = 0; i < kLanes; ++i) {
    uint32_t at = seed * 100 + i;
    Vec3 ng = direction(at, 0), n = glm::normalize(ng + direction(at, 1) * 0.3f);
    set(b.point, i, direction(at, 2));
    set(b.normal, i, n), set(b.geometric, i, ng);
    set(b.throughput, i, Vec3(number(at, 20), 0.5f, 0.25f));
    set(b.color, i, Vec3(0.7f, number(at, 21), 0.2f));
    float between = glm::dot(ng, n);
    b.scale[i] = between < kNormalsAgree ? 1 / horizon_albedo(between) : 1.0f;
    b.eta2[i] = 1;
    b.segments[i] = 1 + i % 7, b.bounces[i] = i % 7;
    b.key[i] = hash32(at), b.sample[i] = i;
    b.area[i] = i % 2, b.sky[i] = !b.area[i], b.one_sided[i] = i % 4 == 1;
    for (uint32_t corner = 0; corner < 3; ++corner)
      set(b.corner[corner], i, direction(at, 30 + corner) * 3.0f);
    b.density[i] = 0.3f, b.side[i] = 1,
    b.height[i] = b.sky[i] ? number(at, 40) * 2 - 1 : std::nanf(""); // others hold anything
    set(b.emission, i, Vec3(2, 3, 4));
  }
  return b;
}

EnvironmentLight some_sky() {
  static const std::vector<float> density(kSkyBands, 1 / (4 * kPi));
  EnvironmentLight sky;
  sky.is_sky = true;
  sky.zenith = Vec3(1, 2, 3), sky.horizon = Vec3(4, 5, 6), sky.ground = Vec3(0.5f);
  sky.density = density.data();
  return sky;
}

TEST(Kernels, GiveTheSameBitsOnEveryInstructionSet) {
  EnvironmentLight sky = some_sky();
  for (uint32_t seed = 0; seed < 50; ++seed) {
    std::vector<ScatterBlock> results;
    for (const Kernels* kernels : runnable_kernels()) {
      ScatterBlock b = some_block(seed);
      kernels->draw_vertices(b, 2);
      kernels->sample_lights(b, &sky, 1, 2);
      kernels->scatter_diffuse(b);
      results.push_back(b);
    }
    for (const ScatterBlock& b : results)
      EXPECT_EQ(std::memcmp(&b, results.data(), sizeof b), 0) << seed;
  }
  EXPECT_GE(runnable_kernels().size(), 1u);
}

TEST(Kernels, ScatterAsTheBsdfDoes) {
  int lit = 0, alive = 0;
  EnvironmentLight sky = some_sky();
  for (uint32_t seed = 0; seed < 50; ++seed) {
    ScatterBlock b = some_block(seed);
    for (uint32_t& bounces : b.bounces)
      bounces = 0; // no roulette
    ScatterBlock before = b;
    kernels().draw_vertices(b, 2);
    kernels().sample_lights(b, &sky, 1, 2);
    kernels().scatter_diffuse(b);
    for (size_t i = 0; i < kLanes; ++i) {
      auto vector = [&](const LaneFloats(&lanes)[3]) { return Vec3(lanes[0][i], lanes[1][i], lanes[2][i]); };
      SurfaceValues values;
      values.color = vector(b.color), values.ior = 1;
      Vec3 ng = vector(b.geometric), n = vector(b.normal);
      Bsdf bsdf(values, n, ng, n, {}); // seen along the shading normal, which nothing turns
      Vec3 throughput = vector(before.throughput), in = vector(b.to_light);
      BsdfValue value = bsdf.evaluate(in);
      Vec3 expected =
          throughput * value.f_cos * vector(b.radiance) * (power_heuristic(b.light_pdf[i], value.pdf) / b.light_pdf[i]);
      if (b.lit[i]) {
        EXPECT_NEAR(glm::length(vector(b.contribution) - expected), 0, 1e-5f * glm::length(expected));
        ++lit;
      } else {
        EXPECT_TRUE(!(b.light_pdf[i] > 0) || is_black(value.f_cos));
      }
      Draws<uint32_t> draws{b.key[i], b.sample[i]};
      Vec2 u;
      draws.two(dimension_of(b.segments[i], kDirection), u.x, u.y);
      BsdfSample next = bsdf.sample(0.5f, u);
      EXPECT_EQ(bool(b.survives[i]), next.valid && !is_black(next.weight));
      if (!b.survives[i]) continue;
      EXPECT_EQ(vector(b.direction), next.direction);
      EXPECT_NEAR(b.pdf[i], next.pdf, 1e-6f);
      EXPECT_NEAR(glm::length(vector(b.throughput) - throughput * next.weight), 0, 1e-5f);
      ++alive;
    }
  }
  EXPECT_GT(lit, 100);
  EXPECT_GT(alive, 600);
}

TEST(Kernels, PlacePointsAsGeometryDoes) {
  testing::TemporaryFolder folder;
  folder.write("two.obj",
               "v 0 0 0\nv 1 0 0.2\nv 0 1 0.1\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nvn 0.3 0 1\nvn 0 0.3 1\n"
               "f 1/1/1 2/2/2 3/3/3\nf 2/2/2 4/1/1 3/3/3\n");
  Folders folders = folder.folders();
  SceneReading reading =
      parse_lua_scene(folder / "scene.lua",
                      "camera{from={0,0,5}} obj{file='two.obj'} obj{file='two.obj', scale={1,2,-3}, rotate={10,20,30},"
                      "translate={1,2,3}} rectangle{}",
                      folders);
  ASSERT_TRUE(reading.scene) << reading.error;
  std::string error;
  std::unique_ptr<Geometry> geometry = Geometry::build(*reading.scene, error);
  ASSERT_TRUE(geometry) << error;
  std::vector<float> inputs[24], distance(kLanes), offset(kLanes), outward[3];
  std::vector<uint8_t> backface(kLanes);
  std::vector<int64_t> id(kLanes);
  PointArrays arrays{};
  for (size_t c = 0; c < 24; ++c)
    inputs[c].resize(kLanes), arrays.inputs[c] = inputs[c].data();
  for (size_t c = 0; c < 3; ++c)
    outward[c].resize(kLanes), arrays.outward[c] = outward[c].data();
  arrays.backface = backface.data(), arrays.id = id.data();
  arrays.distance = distance.data(), arrays.offset = offset.data();
  for (uint32_t round = 0; round < 40; ++round) {
    Ray rays[kLanes];
    Met met[kLanes];
    bool mixed = round % 2;
    for (uint32_t i = 0; i < kLanes; ++i) {
      uint32_t object = mixed ? i % 3 : round % 3, at = round * 100 + i;
      rays[i] = {direction(at, 0) * 4.0f, 0, direction(at, 1), kInfinity};
      met[i] = {i, 0.01f, 0.001f, &rays[i], {object, i / 3 % 2, 1}};
    }
    for (const Kernels* kernels : runnable_kernels()) {
      Met copy[kLanes];
      std::copy(std::begin(met), std::end(met), copy);
      kernels->triangle_points(geometry->sources().data(), copy, kLanes, 0xffffffu, true, arrays, 0);
      for (size_t i = 0; i < kLanes; ++i) {
        SurfacePoint s = geometry->surface(rays[i], met[i].hit);
        float side = glm::dot(s.geometric_normal, rays[i].direction) > 0 ? -1.0f : 1.0f;
        auto vector = [&](Channel c) { return Vec3(inputs[c][i], inputs[c + 1][i], inputs[c + 2][i]); };
        EXPECT_EQ(vector(kWorld), s.world);
        EXPECT_EQ(vector(kLocal), s.local);
        EXPECT_EQ(vector(kGeometric), s.geometric_normal * side);
        EXPECT_EQ(vector(kNormal), s.shading_normal * side);
        EXPECT_EQ(vector(kDpdu), s.dpdu);
        EXPECT_EQ(vector(kDpdv), s.dpdv);
        EXPECT_EQ(Vec2(inputs[kUv][i], inputs[kUv + 1][i]), s.uv);
        EXPECT_EQ(distance[i], s.distance);
        EXPECT_EQ(offset[i], s.offset);
        EXPECT_EQ(backface[i], side < 0);
      }
    }
  }
}

} // namespace
} // namespace moonshade::renderer
