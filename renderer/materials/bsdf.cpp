// The lobes one by one and together.
#include "renderer/materials/bsdf.h"

#include "renderer/materials/ggx.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

namespace {

constexpr float kLeastAlpha = 1e-3f;

float square(float x) { return x * x; }

} // namespace

Vec3 turned_to_viewer(const Vec3& normal, const Vec3& geometric_normal, const Vec3& out) {
  float cosine = glm::dot(normal, out);
  float least = std::min(0.02f, glm::dot(geometric_normal, out));
  return cosine >= least ? normal : normalize_or(normal + out * (least - cosine), out);
}

/// Schlick's approximation; what reflects almost nothing from the front (f0 below 2 %) reflects less at grazing too, so
/// that ior = 1 reflects nothing.
float Bsdf::fresnel(float cosine, float f0) { return f0 + (std::min(1.0f, 50 * f0) - f0) * schlick_power(cosine); }

Bsdf::Bsdf(const SurfaceValues& values, const Vec3& shading_normal, const Vec3& geometric_normal, const Vec3& out)
    : frame_(turned_to_viewer(shading_normal, geometric_normal, out)), ng_(geometric_normal), out_(out),
      local_out_(frame_.to_local(out)), reflectance_(values.reflectance) {
  n_dot_v_ = std::max(local_out_.z, 1e-4f);
  f0_dielectric_ = square((values.ior - 1) / (values.ior + 1));
  f0_ = glm::mix(Vec3(f0_dielectric_), values.color, values.metallic);
  f90_ = std::min(1.0f, 50 * max_component(f0_));
  alpha_ = std::max(square(values.roughness), kLeastAlpha);
  float albedo = ggx_albedo(n_dot_v_, alpha_);
  compensation_ = Vec3(1) + f0_ * ((1 - albedo) / albedo);
  diffuse_ = values.color * (1 - values.metallic);

  float mirror = luminance(reflectance_), base = 1 - mirror;
  float diffuse = luminance(diffuse_) * (1 - fresnel(n_dot_v_, f0_dielectric_));
  float f = luminance(f0_);
  float glossy = f + (f90_ - f) * schlick_power(n_dot_v_);
  if (diffuse + glossy > 0) {
    diffuse_probability_ = base * diffuse / (diffuse + glossy);
    glossy_probability_ = base * glossy / (diffuse + glossy);
  }
  mirror_probability_ = max_component(reflectance_) > 0 ? std::max(mirror, 0.05f) : 0.0f;
  float sum = mirror_probability_ + diffuse_probability_ + glossy_probability_;
  if (sum > 0) mirror_probability_ /= sum, diffuse_probability_ /= sum, glossy_probability_ /= sum;
}

/// The glossy lobe for one direction in the shading frame's upper half: value times cosine, and density.
float Bsdf::glossy_pdf_and_value(const Vec3& in, Vec3& f_cos) const {
  Vec3 l = frame_.to_local(in);
  if (l.z <= 0) return 0;
  Vec3 h = normalize_or(l + local_out_, Vec3(0, 0, 1));
  float v_dot_h = std::max(glm::dot(local_out_, h), 0.0f);
  float density = ggx_density(h, alpha_);
  float lambda_v = ggx_lambda(local_out_, alpha_), lambda_l = ggx_lambda(l, alpha_);
  Vec3 f = f0_ + (Vec3(f90_) - f0_) * schlick_power(v_dot_h);
  f_cos += f * compensation_ * (density / ((1 + lambda_v + lambda_l) * 4 * n_dot_v_));
  return density / ((1 + lambda_v) * 4 * n_dot_v_);
}

BsdfValue Bsdf::evaluate(const Vec3& in) const {
  BsdfValue value;
  float side = glm::dot(in, ng_);
  if (side <= 0) return value;
  Vec3 f_cos(0);
  float cosine = glm::dot(in, frame_.n);
  if (cosine > 0 && diffuse_probability_ > 0) {
    // Chiang et al.: smooth towards the geometric horizon, 1 where both normals agree.
    float shade = std::min(1.0f, side / (cosine * std::max(glm::dot(ng_, frame_.n), 1e-4f)));
    shade = -shade * shade * shade + shade * shade + shade;
    float through = (1 - fresnel(n_dot_v_, f0_dielectric_)) * (1 - fresnel(cosine, f0_dielectric_));
    // 1/21 is the cosine-weighted average of Schlick's fifth power: what enters on average leaves again, but for the
    // colour.
    float average = f0_dielectric_ + (std::min(1.0f, 50 * f0_dielectric_) - f0_dielectric_) / 21;
    f_cos += diffuse_ * (kInvPi * cosine * shade * through / (1 - average));
    value.pdf += diffuse_probability_ * cosine * kInvPi;
  }
  if (glossy_probability_ > 0) {
    float pdf = glossy_pdf_and_value(in, f_cos);
    pdf += glossy_pdf_and_value(folded(in), f_cos);
    value.pdf += glossy_probability_ * pdf;
  }
  value.f_cos = f_cos * (Vec3(1) - reflectance_);
  return value;
}

Vec3 Bsdf::mirror_direction() const {
  Vec3 direction = frame_.n * (2 * glm::dot(out_, frame_.n)) - out_;
  if (glm::dot(direction, ng_) < 0) direction = folded(direction);
  return normalize_or(direction, ng_);
}

BsdfSample Bsdf::sample(float choice, const Vec2& u) const {
  BsdfSample sample;
  if (choice < mirror_probability_) {
    sample.direction = mirror_direction();
    sample.weight = reflectance_ / mirror_probability_;
    sample.mirror = true;
    sample.valid = true;
    return sample;
  }
  if (choice < mirror_probability_ + diffuse_probability_) {
    sample.direction = frame_.to_world(sample_cosine_hemisphere(u));
    sample.spread = 0.3f;
  } else if (glossy_probability_ > 0) {
    Vec3 h = ggx_sample_visible_normal(local_out_, alpha_, u);
    Vec3 l = h * (2 * glm::dot(local_out_, h)) - local_out_;
    if (l.z <= 0) return sample;
    sample.direction = frame_.to_world(l);
    if (glm::dot(sample.direction, ng_) < 0) sample.direction = folded(sample.direction);
    sample.spread = 0.3f * alpha_;
  } else {
    return sample;
  }
  sample.direction = normalize_or(sample.direction, ng_);
  BsdfValue value = evaluate(sample.direction);
  if (!(value.pdf > 0)) return sample;
  sample.weight = value.f_cos / value.pdf;
  sample.pdf = value.pdf;
  sample.valid = true;
  return sample;
}

} // namespace moonshade::renderer
