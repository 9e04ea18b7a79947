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

bool same_bits(const void* a, const void* b, size_t size) { return std::memcmp(a, b, size) == 0; }

/// Often one of the ends.
float share(uint32_t a, uint32_t b) {
  float u = number(a, b);
  return u < 0.3f ? 0 : u > 0.7f ? 1 : (u - 0.3f) / 0.4f;
}

/// What blocks are made of.
enum class Kind { Any, Diffuse, Coated, Metal, Glass, Sheets, Smooth, Mirrors, Count };

SurfaceValues surface(Kind kind, uint32_t at) {
  const float indices[] = {1, 1.0001f, 1.5f, 3, 100};
  SurfaceValues v;
  v.color = Vec3(share(at, 60), number(at, 61), 0.2f);
  v.roughness = kind == Kind::Smooth ? 0.02f * number(at, 62) : share(at, 62);
  v.metallic = kind == Kind::Metal ? 1 : share(at, 63);
  v.transmission = kind == Kind::Glass || kind == Kind::Sheets ? 1 : share(at, 64);
  v.ior = indices[at * 2654435761u % 5];
  if (kind == Kind::Any || kind == Kind::Mirrors) v.reflectance = Vec3(share(at, 65), 0.5f * share(at, 66), 0);
  if (kind == Kind::Coated || kind == Kind::Glass || kind == Kind::Sheets) v.metallic = 0;
  if (kind == Kind::Coated) v.transmission = 0, v.ior = std::max(v.ior, 1.3f);
  if (kind == Kind::Diffuse) v.metallic = v.transmission = 0, v.ior = 1;
  return v;
}

/// Points of surfaces, a triangle or a sky as light; and the paths that have come there.
struct Vertices {
  Kind kind;
  ScatterBlock block{};
  Path paths[kLanes];
  LightTriangle triangles[kLanes];

  explicit Vertices(uint32_t seed, uint32_t bounces = 7) : kind(Kind(seed % uint32_t(Kind::Count))) {
    for (uint32_t i = 0; i < kLanes; ++i)
      set_point(i, seed * 100 + i, bounces);
  }
  void set_point(uint32_t i, uint32_t at, uint32_t bounces) {
    ScatterBlock& b = block;
    Vec3 ng = direction(at, 0), out = direction(at, 50);
    if (glm::dot(out, ng) < 0) out = -out;
    if (i % 5 == 0) out = glm::normalize(out - ng * (0.99f * glm::dot(out, ng))); // grazing
    Vec3 n = i % 4 == 0 ? ng : glm::normalize(ng + direction(at, 1) * (i % 3 ? 0.3f : 2.0f));
    n = turned_to_viewer(glm::dot(n, ng) < 0 ? -n : n, ng, out);
    set(b.point, i, direction(at, 2));
    set(b.normal, i, n), set(b.geometric, i, ng);
    b.offset[i] = 1e-6f, b.width[i] = 0.01f * float(i), b.owner[i] = 100 + i;
    SurfaceValues values = surface(kind, at);
    set(b.color, i, values.color), set(b.reflectance, i, values.reflectance);
    b.roughness[i] = values.roughness, b.metallic[i] = values.metallic;
    b.ior[i] = values.ior, b.transmission[i] = values.transmission;
    b.backface[i] = at / 2 % 2;
    Path& path = paths[i];
    path.ray.direction = -out;
    path.throughput = Vec3(number(at, 20), 0.5f, 0.25f);
    path.radiance = Vec3(1, 2, 3);
    path.segments = 1 + i % 7, path.bounces = i % bounces;
    path.sampler = Sampler(at, 0, i);
    path.spread = 0.1f, path.travelled = 1, path.faulted = i % 3 == 0;
    path.media.ids[0] = i;
    b.sky[i] = i % 2 == 0;
    b.height[i] = b.sky[i] ? number(at, 40) * 2 - 1 : std::nanf(""); // others hold anything
    if (!b.sky[i])
      triangles[i] = {direction(at, 30) * 3.0f,
                      0.3f,
                      direction(at, 31) * 3.0f,
                      1,
                      direction(at, 32) * 3.0f,
                      i % 4 == 1 ? 1.0f : 0.0f,
                      Vec3(2, 3, 4),
                      1};
  }
  bool thin() const { return kind == Kind::Sheets || kind == Kind::Smooth; }
  void scatter(const Kernels& kernels, const EnvironmentLight& sky) {
    for (size_t i = 0; i < kLanes; ++i)
      block.paths[i] = &paths[i], block.triangles[i] = &triangles[i];
    kernels.draw_vertices(block, 2);
    kernels.sample_lights(block, &sky, 1, 2);
    AlbedoTables albedos = albedo_tables({true, true});
    if (kind == Kind::Diffuse)
      kernels.scatter_diffuse(block, albedos);
    else
      kernels.scatter(block, albedos, thin());
    for (size_t i = 0; i < kLanes; ++i) // which are no results
      block.paths[i] = nullptr, block.triangles[i] = nullptr;
  }
};

EnvironmentLight some_sky() {
  static const std::vector<float> density(kSkyBands, 1 / (4 * kPi));
  EnvironmentLight sky;
  sky.is_sky = true;
  sky.zenith = Vec3(1, 2, 3), sky.horizon = Vec3(4, 5, 6), sky.ground = Vec3(0.5f);
  sky.density = density.data();
  return sky;
}

constexpr uint32_t kBlocks = 50 * uint32_t(Kind::Count);

TEST(Kernels, GiveTheSameBitsOnEveryInstructionSet) {
  EnvironmentLight sky = some_sky();
  for (uint32_t seed = 0; seed < kBlocks; ++seed) {
    std::vector<Vertices> results;
    for (const Kernels* kernels : runnable_kernels()) {
      results.emplace_back(seed);
      results.back().scatter(*kernels, sky);
    }
    for (const Vertices& v : results) {
      EXPECT_TRUE(same_bits(&v.block, &results[0].block, sizeof v.block)) << seed;
      EXPECT_TRUE(same_bits(v.paths, results[0].paths, sizeof v.paths)) << seed;
    }
  }
  EXPECT_GE(runnable_kernels().size(), 1u);
}

TEST(Kernels, GiveAPointTheSameBitsWhoeverIsBesideIt) {
  EnvironmentLight sky = some_sky();
  for (uint32_t seed = 0; seed < kBlocks; ++seed) {
    Vertices before(seed), together = before;
    together.scatter(kernels(), sky);
    for (size_t i = 0; i < kLanes; ++i) {
      Vertices alone = before; // as a block with one point is filled
      for (LaneFloats* lanes = alone.block.point; lanes != &alone.block.transmission + 1; ++lanes)
        std::fill_n(*lanes, kLanes, (*lanes)[i]);
      std::fill_n(alone.block.owner, kLanes, before.block.owner[i]);
      std::fill_n(alone.block.backface, kLanes, before.block.backface[i]);
      std::fill_n(alone.block.sky, kLanes, before.block.sky[i]);
      std::fill_n(alone.block.height, kLanes, before.block.height[i]);
      std::fill_n(alone.paths, kLanes, before.paths[i]);
      std::fill_n(alone.triangles, kLanes, before.triangles[i]);
      alone.scatter(kernels(), sky);
      EXPECT_TRUE(same_bits(&alone.paths[i], &together.paths[i], sizeof(Path))) << seed << " " << i;
      EXPECT_EQ(alone.block.lit[i], together.block.lit[i]);
      EXPECT_EQ(alone.block.straight[i], together.block.straight[i]);
      if (together.block.lit[i])
        EXPECT_TRUE(same_bits(&alone.block.shadows[i], &together.block.shadows[i], sizeof(Shadow)));
    }
  }
}

/// What a kernel has made of one path and its light, against the code for one point.
struct Scattered {
  int lit = 0, alive = 0, straight = 0, refracted = 0, mirrored = 0;

  void compare(const Vertices& before, const Vertices& after, size_t i) {
    const ScatterBlock& b = after.block;
    auto vector = [&](const LaneFloats(&lanes)[3]) { return Vec3(lanes[0][i], lanes[1][i], lanes[2][i]); };
    SurfaceValues values;
    values.color = vector(b.color), values.reflectance = vector(b.reflectance);
    values.roughness = b.roughness[i], values.metallic = b.metallic[i];
    values.ior = b.ior[i], values.transmission = b.transmission[i];
    const Path &old = before.paths[i], &path = after.paths[i];
    Vec3 ng = vector(b.geometric), out = -old.ray.direction;
    Bsdf bsdf(values, vector(b.normal), ng, out, {bool(b.backface[i]), after.thin(), false});
    Vec3 in = vector(b.to_light);
    auto leaves = [&](const Ray& ray) {
      Vec3 step = ng * (glm::dot(ray.direction, ng) < 0 ? -b.offset[i] : b.offset[i]);
      EXPECT_EQ(ray.origin, vector(b.point) + step);
      EXPECT_EQ(ray.near, 0);
    };
    BsdfValue value = bsdf.evaluate(in);
    if (b.lit[i]) {
      float weight = power_heuristic(b.light_pdf[i], value.pdf) / b.light_pdf[i];
      EXPECT_EQ(b.shadows[i].contribution, old.throughput * value.f_cos * vector(b.radiance) * weight);
      EXPECT_EQ(b.shadows[i].owner, b.owner[i]);
      EXPECT_EQ(b.shadows[i].ray.direction, in);
      EXPECT_EQ(b.shadows[i].ray.far, shadow_end(b.light_distance[i], b.offset[i]));
      leaves(b.shadows[i].ray);
      ++lit;
    } else {
      EXPECT_TRUE(!(b.light_pdf[i] > 0) || is_black(old.throughput * value.f_cos));
    }
    EXPECT_EQ(path.radiance, old.radiance);
    EXPECT_EQ(path.faulted, old.faulted);
    EXPECT_EQ(path.media.ids[0], uint32_t(i));
    EXPECT_EQ(path.segments, old.segments);
    EXPECT_EQ(path.sampler.one(5), old.sampler.one(5));
    float choice = old.sampler.one(dimension_of(old.segments, kLobe));
    BsdfSample next = bsdf.sample(choice, old.sampler.two(dimension_of(old.segments, kDirection)));
    bool goes_on = next.valid && !is_black(next.weight);
    EXPECT_EQ(b.straight[i], goes_on && next.straight);
    if (goes_on) {
      EXPECT_EQ(path.throughput, old.throughput * next.weight);
      EXPECT_EQ(path.eta2, old.eta2 * next.eta2);
    }
    if (b.straight[i]) {
      EXPECT_TRUE(same_bits(&path.from, &old.from, sizeof(Path) - offsetof(Path, from)));
      EXPECT_EQ(path.ray.direction, old.ray.direction);
      ++straight;
      return;
    }
    EXPECT_EQ(path.alive, goes_on);
    if (!path.alive) return;
    leaves(path.ray);
    EXPECT_EQ(path.ray.direction, next.direction);
    EXPECT_EQ(path.ray.far, kInfinity);
    EXPECT_EQ(path.pdf, next.pdf);
    EXPECT_EQ(path.from, path.ray.origin);
    EXPECT_EQ(path.bounces, old.bounces + 1);
    EXPECT_EQ(path.width, b.width[i]);
    EXPECT_EQ(path.spread, old.spread + next.spread);
    EXPECT_EQ(path.travelled, 0);
    EXPECT_EQ(path.mirror, next.mirror);
    ++alive, refracted += path.eta2 != 1, mirrored += path.mirror;
  }
};

TEST(Kernels, ScatterAsTheBsdfDoes) {
  Scattered scattered;
  EnvironmentLight sky = some_sky();
  for (uint32_t seed = 0; seed < kBlocks; ++seed) {
    Vertices before(seed, 1), after = before; // without a bounce, no roulette
    after.scatter(kernels(), sky);
    for (size_t i = 0; i < kLanes; ++i)
      scattered.compare(before, after, i);
    if (::testing::Test::HasFailure()) FAIL() << "block " << seed;
  }
  EXPECT_GT(scattered.lit, 1500);
  EXPECT_GT(scattered.alive, 4500);
  EXPECT_GT(scattered.straight, 100);
  EXPECT_GT(scattered.refracted, 300);
  EXPECT_GT(scattered.mirrored, 1000);
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
  std::vector<float> inputs[24], distance(kLanes), offset(kLanes), width(kLanes), outward[3];
  std::vector<uint8_t> backface(kLanes);
  std::vector<int64_t> id(kLanes);
  PointArrays arrays{};
  for (size_t c = 0; c < 24; ++c)
    inputs[c].resize(kLanes), arrays.inputs[c] = inputs[c].data();
  for (size_t c = 0; c < 3; ++c)
    outward[c].resize(kLanes), arrays.outward[c] = outward[c].data();
  arrays.backface = backface.data(), arrays.id = id.data();
  arrays.distance = distance.data(), arrays.offset = offset.data(), arrays.width = width.data();
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
      kernels->triangle_points(geometry->sources().data(), met, kLanes, 0xffffffu, true, arrays, 0);
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
        EXPECT_EQ(width[i], 0.01f + 0.001f * s.distance);
        EXPECT_EQ(backface[i], side < 0);
      }
    }
  }
}

} // namespace
} // namespace moonshade::renderer
