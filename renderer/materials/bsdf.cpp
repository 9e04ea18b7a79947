#include "renderer/materials/bsdf.h"

namespace moonshade::renderer {

static lanes::V3<float> lane(const Vec3& v) { return {{v.x, v.y, v.z}}; }
static Vec3 vector(const lanes::V3<float>& v) { return {v[0], v[1], v[2]}; }

Vec3 turned_to_viewer(const Vec3& normal, const Vec3& geometric_normal, const Vec3& out) {
  return vector(turned_to_viewer(lane(normal), lane(geometric_normal), lane(out)));
}

static lanes::Bsdf<float> of_one(const SurfaceValues& v, const Vec3& shading_normal, const Vec3& geometric_normal,
                                 const Vec3& out, SurfaceSide side) {
  SurfaceKinds kinds{.metal = v.metallic > 0,
                     .coat = v.metallic < 1 && v.transmission < 1 && v.ior > 1,
                     .glass = v.metallic < 1 && v.transmission > 0,
                     .rough = !(v.roughness * v.roughness < kSmoothAlpha),
                     .thin = side.thin};
  return {{lane(v.color), lane(v.reflectance), v.roughness, v.metallic, v.ior, v.transmission},
          {lane(shading_normal), lane(geometric_normal), lane(out), {side.backface}},
          side.thin,
          side.photons,
          albedo_tables(albedo_needs(kinds))};
}

Bsdf::Bsdf(const SurfaceValues& values, const Vec3& shading_normal, const Vec3& geometric_normal, const Vec3& out,
           SurfaceSide side)
    : lanes_(of_one(values, shading_normal, geometric_normal, out, side)) {}

BsdfValue Bsdf::evaluate(const Vec3& in, uint8_t lobes) const {
  lanes::BsdfValue<float> value = lanes_.evaluate(lane(in), lobes, {true});
  return {vector(value.f_cos), value.pdf};
}

BsdfSample Bsdf::sample(float choice, const Vec2& u, uint8_t lobes) const {
  lanes::BsdfSample<float> s = lanes_.sample(choice, u.x, u.y, lobes);
  if (!s.valid.bits) return {};
  return {vector(s.direction), vector(s.weight), s.pdf, s.mirror.bits, s.straight.bits, true, s.spread, s.eta2};
}

Vec3 Bsdf::mirror_direction() const { return vector(lanes_.mirror_direction()); }

Vec3 Bsdf::straight_through() const {
  if (!lanes_.thin || !smooth()) return Vec3(0);
  return vector(lanes::times(lanes_.keep, lanes_.split(lanes_.n_dot_v).transmitted));
}

Vec3 Bsdf::ambient(const Vec3& around_normal, const Vec3& around_mirror) const {
  Vec3 glossy(0);
  if (!transmits() && !smooth()) {
    lanes::Bsdf<float>::Scales metal{{{lanes_.metal, lanes_.metal, lanes_.metal}}, 0, 0};
    glossy = vector(lanes_.reflected(lanes_.n_dot_v, metal, 0)) + lanes_.coat * lanes_.coat_at_view;
  }
  return diffuse_albedo() * around_normal + vector(lanes_.keep) * glossy * around_mirror;
}

Vec3 Bsdf::diffuse_albedo() const { return vector(lanes_.keep) * vector(lanes_.diffuse) * (1 - lanes_.coat_at_view); }

} // namespace moonshade::renderer
