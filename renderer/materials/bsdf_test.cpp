// The BSDF by itself: what it loses, what it samples, Fresnel and Snell, and photons as its dual.
#include "renderer/materials/bsdf.h"

#include "renderer/sampling/sampler.h"

#include <functional>
#include <gtest/gtest.h>
#include <sstream>

namespace moonshade::renderer {
namespace {

Vec3 at_angle(float degrees, float azimuth = 0) {
  float t = degrees * kPi / 180, a = azimuth * kPi / 180;
  return {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
}

const Vec3 kUp(0, 0, 1);

struct Kind {
  const char* name;
  float metallic, transmission, ior;
  bool thin, backface;
};
/// Materials that lose nothing where the colour is white.
const Kind kKinds[] = {{"metal", 1, 0, 1.5f, false, false},
                       {"diffuse", 0, 0, 1, false, false},
                       {"coated", 0, 0, 1.5f, false, false},
                       {"hardly coated", 0, 0, 1.05f, false, false},
                       {"diamond coat", 0, 0, 2.5f, false, false},
                       {"half metal", 0.5f, 0, 2.5f, false, false},
                       {"glass", 0, 1, 1.5f, false, false},
                       {"glass from within", 0, 1, 1.5f, false, true},
                       {"thin glass", 0, 1, 1.5f, true, false},
                       {"thin diamond", 0, 1, 2.4f, true, true},
                       {"some of each", 0.3f, 0.5f, 1.7f, false, false}};
const float kRoughnesses[] = {0, 0.1f, 0.2f, 0.4f, 0.7f, 1};

SurfaceValues values_of(const Kind& kind, float roughness) {
  SurfaceValues values;
  values.color = Vec3(1);
  values.metallic = kind.metallic, values.transmission = kind.transmission, values.ior = kind.ior;
  values.roughness = roughness;
  return values;
}

/// Mean weight of samples: the share of light that leaves. Interfaces' change of radiance is taken out.
Vec3 sampled_albedo(const Bsdf& bsdf, uint32_t samples = 4096) {
  DVec3 sum(0);
  for (uint32_t k = 0; k < samples; ++k) {
    Sampler s(7, 1, k);
    BsdfSample sample = bsdf.sample(s.one(0), s.two(1));
    if (sample.valid) sum += DVec3(sample.weight) * double(sample.eta2);
  }
  return Vec3(sum / double(samples));
}

TEST(Bsdf, WhiteSurfacesLoseAndGiveNothing) {
  for (const Kind& kind : kKinds)
    for (float roughness : kRoughnesses)
      for (float angle : {1.0f, 30.0f, 60.0f, 80.0f}) {
        Bsdf bsdf(values_of(kind, roughness), kUp, kUp, at_angle(angle), {kind.backface, kind.thin, false});
        float albedo = sampled_albedo(bsdf).x;
        EXPECT_NEAR(albedo, 1, 0.0125f) << kind.name << ", roughness " << roughness << ", " << angle << " degrees";
      }
}

TEST(Bsdf, ColouredSurfacesStayBelowTheirCoat) {
  for (const Kind& kind : kKinds)
    for (float roughness : kRoughnesses) {
      SurfaceValues values = values_of(kind, roughness);
      values.color = Vec3(0.5f, 0.1f, 0);
      Vec3 albedo = sampled_albedo(Bsdf(values, kUp, kUp, at_angle(40), {kind.backface, kind.thin, false}));
      EXPECT_LT(albedo.x, 1.0f) << kind.name << roughness;
      EXPECT_GE(albedo.x, albedo.y) << kind.name << roughness;
      EXPECT_GE(albedo.y, albedo.z) << kind.name << roughness;
    }
}

TEST(Bsdf, SteepNormalsLoseNothing) {
  // Normals as bump mapping bends them, to a slope of 8; the viewer anywhere above the surface.
  for (const Kind& kind : kKinds)
    for (float roughness : {0.3f, 0.6f, 1.0f})
      for (float tilt : {20.0f, 60.0f, 82.9f}) {
        double sum = 0;
        int count = 0;
        for (float azimuth : {0.0f, 60.0f, 120.0f, 180.0f}) {
          Vec3 normal = turned_to_viewer(at_angle(tilt, azimuth), kUp, at_angle(35));
          Bsdf bsdf(values_of(kind, roughness), normal, kUp, at_angle(35), {kind.backface, kind.thin, false});
          sum += double(sampled_albedo(bsdf).x);
          ++count;
        }
        // Grazing views of rough facets fold twice; nothing comes near to black.
        EXPECT_NEAR(sum / count, 1, 0.06) << kind.name << ", roughness " << roughness << ", tilt " << tilt;
      }
}

/// Over the sphere, in rings of equal solid angle.
void integrate(const std::function<void(const Vec3&, double)>& visit) {
  constexpr int kRings = 400, kAround = 400;
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kAround; ++j) {
      float z = -1 + 2 * (float(i) + 0.5f) / kRings, r = std::sqrt(1 - z * z),
            phi = 2 * kPi * (float(j) + 0.5f) / kAround;
      visit({r * std::cos(phi), r * std::sin(phi), z}, 4 * M_PI / (kRings * kAround));
    }
}

TEST(Bsdf, SamplesAreWhatItEvaluates) {
  for (const Kind& kind : kKinds)
    for (float roughness : {0.5f, 0.8f})
      for (float tilt : {0.0f, 40.0f}) {
        Bsdf bsdf(values_of(kind, roughness), at_angle(tilt, 70), kUp, at_angle(45), {kind.backface, kind.thin, false});
        double value = 0, density = 0;
        integrate([&](const Vec3& in, double share) {
          BsdfValue v = bsdf.evaluate(in);
          bool across = in.z < 0 && !kind.thin;
          float eta = kind.backface ? 1 / kind.ior : kind.ior;
          value += double(v.f_cos.x) * double(across ? eta * eta : 1.0f) * share;
          density += double(v.pdf) * share;
        });
        EXPECT_NEAR(value, double(sampled_albedo(bsdf, 16384).x), 0.02) << kind.name << roughness << " " << tilt;
        EXPECT_LE(density, 1.01) << kind.name << roughness;
        EXPECT_GT(density, 0.6) << kind.name << roughness; // the rest leaves no sample
      }
}

TEST(Bsdf, PhotonsAreItsDual) {
  // What a photon from a to b carries is what b sees of a.
  for (const Kind& kind : kKinds)
    for (float roughness : {0.4f, 0.9f})
      for (float b_angle : {15.0f, 70.0f, 120.0f, 160.0f}) {
        SurfaceValues values = values_of(kind, roughness);
        values.color = Vec3(0.9f, 0.5f, 0.2f);
        Vec3 a = at_angle(50), b = at_angle(b_angle, 150);
        bool across = b.z < 0;
        Bsdf photon(values, kUp, kUp, a, {kind.backface, kind.thin, true});
        Bsdf seen(values, across ? -kUp : kUp, across ? -kUp : kUp, b, {kind.backface != across, kind.thin, false});
        Vec3 carried = photon.evaluate(b).f_cos / std::abs(b.z), sight = seen.evaluate(a).f_cos / std::abs(a.z);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(carried[c], sight[c], 2e-3f * std::max(1.0f, sight[c]))
              << kind.name << roughness << " " << b_angle;
      }
}

TEST(Fresnel, IsThatOfTheTables) {
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnel_dielectric(std::cos(kPi / 4), 1.5f), 0.050240f, 1e-5f);
  EXPECT_NEAR(fresnel_dielectric(std::cos(std::atan(1.5f)), 1.5f), 0.073965f, 1e-5f); // Brewster: one polarisation
  EXPECT_NEAR(fresnel_dielectric(0.0f, 1.5f), 1, 1e-6f);
  EXPECT_NEAR(fresnel_dielectric(1.0f, 2.417f), 0.171967f, 1e-5f);      // diamond
  EXPECT_EQ(fresnel_dielectric(std::cos(42 * kPi / 180), 1 / 1.5f), 1); // beyond 41.8 degrees
  EXPECT_LT(fresnel_dielectric(std::cos(41 * kPi / 180), 1 / 1.5f), 1);
  EXPECT_NEAR(fresnel_dielectric(0.3f, 1), 0, 1e-12f);
}

TEST(Snell, BendsTowardsTheNormal) {
  SurfaceValues glass = values_of({"", 0, 1, 1.5f, false, false}, 0);
  BsdfSample through = Bsdf(glass, kUp, kUp, at_angle(30)).sample(0.999f, {0, 0});
  ASSERT_TRUE(through.valid && through.mirror);
  EXPECT_NEAR(-through.direction.x, 0.5f / 1.5f, 1e-5f);
  EXPECT_NEAR(through.direction.z, -std::sqrt(1 - 1 / 9.0f), 1e-5f);
  EXPECT_FLOAT_EQ(through.eta2, 2.25f);
  Bsdf out(glass, kUp, kUp, at_angle(30), {true, false, false});
  BsdfSample left = out.sample(0.999f, {0, 0});
  EXPECT_NEAR(-left.direction.x, 0.75f, 1e-5f);
  // Beyond the critical angle everything is reflected.
  BsdfSample total = Bsdf(glass, kUp, kUp, at_angle(45), {true, false, false}).sample(0.999f, {0, 0});
  EXPECT_GT(total.direction.z, 0);
  EXPECT_NEAR(total.weight.x, 1, 1e-5f);
}

TEST(Snell, ThinSheetsLetLightGoStraight) {
  SurfaceValues pane = values_of({"", 0, 1, 1.5f, true, false}, 0);
  pane.color = Vec3(0.5f);
  Bsdf bsdf(pane, kUp, kUp, at_angle(0), {false, true, false});
  BsdfSample sample = bsdf.sample(0.999f, {0, 0});
  EXPECT_TRUE(sample.straight);
  EXPECT_EQ(sample.direction, -at_angle(0));
  EXPECT_NEAR(bsdf.straight_through().x, 0.5f * (1 - 0.08f / 1.04f), 1e-5f);
}

} // namespace
} // namespace moonshade::renderer
