// The lobes one by one and together.
#include "renderer/materials/bsdf.h"

#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

namespace {

constexpr float kSmoothAlpha = 1e-3f;
/// Rough interfaces of (nearly) equal indices bend light by nothing, and half vectors vanish.
constexpr float kLeastIndexStep = 1e-3f;

float square(float x) { return x * x; }

} // namespace

Vec3 turned_to_viewer(const Vec3& normal, const Vec3& geometric_normal, const Vec3& out) {
  auto lane = [](const Vec3& v) { return lanes::V3<float>{{v.x, v.y, v.z}}; };
  lanes::V3<float> turned = turned_to_viewer(lane(normal), lane(geometric_normal), lane(out));
  return {turned[0], turned[1], turned[2]};
}

Bsdf::Bsdf(const SurfaceValues& values, const Vec3& shading_normal, const Vec3& geometric_normal, const Vec3& out,
           SurfaceSide side)
    : frame_(turned_to_viewer(shading_normal, geometric_normal, out)), ng_(geometric_normal), out_(out),
      local_out_(frame_.to_local(out)), reflectance_(values.reflectance), keep_(Vec3(1) - values.reflectance),
      color_(values.color), ior_(values.ior), thin_(side.thin), photons_(side.photons) {
  metal_ = values.metallic;
  glass_ = (1 - metal_) * values.transmission;
  coat_ = (1 - metal_) * (1 - values.transmission);
  diffuse_ = color_ * coat_;
  n_dot_v_ = std::max(local_out_.z, 1e-4f);
  alpha_ = square(values.roughness);
  smooth_ = alpha_ < kSmoothAlpha;
  ng_dot_n_ = glm::dot(ng_, frame_.n);
  if (ng_dot_n_ < kNormalsAgree) diffuse_scale_ = 1 / horizon_albedo(ng_dot_n_);
  eta_ = ior_;
  if (glass_ > 0) {
    if (!smooth_) eta_ = std::max(eta_, 1 + kLeastIndexStep);
    if (side.backface && !thin_) eta_ = 1 / eta_;
    glass_tint_ = thin_ ? color_ : glm::sqrt(color_);
  }
  if (coat_ > 0 && ior_ > 1) {
    coat_albedo_ = CoatAlbedo(std::max(alpha_, 1e-4f), ior_);
    coat_albedo_v_ = smooth_ ? fresnel_dielectric(n_dot_v_, ior_) : coat_albedo_.at(n_dot_v_);
  }
  scales_ = scales(n_dot_v_, eta_);

  float mirror = luminance(reflectance_);
  weight_.mirror = max_component(reflectance_) > 0 ? std::max(mirror, 0.05f) : 0.0f;
  weight_.diffuse = (1 - mirror) * luminance(diffuse_) * (1 - coat_albedo_v_);
  float metal = luminance(glm::mix(color_, Vec3(1), schlick_power(n_dot_v_)));
  weight_.facet = (1 - mirror) * (metal_ * metal + coat_ * coat_albedo_v_ +
                                  (glass_ > 0 ? glass_ * std::max(luminance(glass_tint_), 0.1f) : 0.0f));
}

/// How much each facet lobe is scaled for light from this cosine that bounces more than once.
Bsdf::Scales Bsdf::scales(float cosine, float eta_glass) const {
  Scales s{Vec3(metal_), coat_, glass_};
  if (smooth_ || (metal_ == 0 && coat_ == 0 && glass_ == 0)) return s;
  if (metal_ > 0 || coat_ > 0 || thin_) {
    float albedo = ggx_albedo(cosine, alpha_), lost = (1 - albedo) / albedo;
    s.metal *= Vec3(1) + color_ * lost;
    s.coat *= 1 + square((ior_ - 1) / (ior_ + 1)) * lost;
    if (thin_) s.glass /= albedo;
  }
  if (glass_ > 0 && !thin_) s.glass /= glass_albedo(cosine, alpha_, eta_glass);
  return s;
}

/// Two interfaces, and all that bounces between them (Stokes).
static float thin_reflectance(float f) { return 2 * f / (1 + f); }

/// Share of light that facets met at this cosine reflect, all lobes together.
Vec3 Bsdf::reflected(float cosine, const Scales& s) const {
  Vec3 sum(0);
  if (metal_ > 0) sum += s.metal * glm::mix(color_, Vec3(1), schlick_power(cosine));
  if (coat_ > 0 && ior_ > 1) sum += s.coat * fresnel_dielectric(cosine, ior_);
  if (glass_ > 0) {
    float f = fresnel_dielectric(cosine, eta_);
    sum += s.glass * (thin_ ? thin_reflectance(f) : f);
  }
  return sum;
}

/// Share that they let through; an interface's change of radiance is not in it.
Vec3 Bsdf::transmitted(float cosine, float glass_scale) const {
  if (glass_ <= 0) return Vec3(0);
  float f = fresnel_dielectric(cosine, eta_);
  return glass_tint_ * (glass_scale * (1 - (thin_ ? thin_reflectance(f) : f)));
}

/// How often a sampled facet reflects.
float Bsdf::reflect_share(float cosine) const {
  if (glass_ <= 0) return 1;
  float r = luminance(reflected(cosine, scales_)), t = luminance(transmitted(cosine, scales_.glass));
  return r + t > 0 ? r / (r + t) : 1;
}

Bsdf::Probabilities Bsdf::probabilities(uint8_t lobes) const {
  Probabilities p{lobes & kMirrorLobe ? weight_.mirror : 0, lobes & kDiffuseLobe ? weight_.diffuse : 0,
                  lobes & kFacetLobe ? weight_.facet : 0};
  float sum = p.mirror + p.diffuse + p.facet;
  if (sum > 0) p.mirror /= sum, p.diffuse /= sum, p.facet /= sum;
  return p;
}

/// Veach's correction for shading normals, of what photons carry ("Robust Monte Carlo Methods", 5.3): `cosine` is that
/// of `in` with the shading normal, which the value has been multiplied by.
float Bsdf::photon_factor(const Vec3& in, float cosine) const {
  if (!photons_) return 1;
  return n_dot_v_ * std::abs(glm::dot(in, ng_)) / (std::max(glm::dot(out_, ng_), 1e-4f) * std::max(cosine, 1e-4f));
}

/// One direction in the shading frame's upper half.
void Bsdf::reflect_lobe(const Vec3& in, BsdfValue& value) const {
  Vec3 l = frame_.to_local(in);
  if (l.z <= 0) return;
  Vec3 h = normalize_or(l + local_out_, Vec3(0, 0, 1));
  float c = std::max(glm::dot(local_out_, h), 0.0f);
  float density = ggx_density(h, alpha_);
  float lambda_v = ggx_lambda(local_out_, alpha_), lambda_l = ggx_lambda(l, alpha_);
  Vec3 f = reflected(c, photons_ ? scales(l.z, eta_) : scales_);
  value.f_cos += f * (density / ((1 + lambda_v + lambda_l) * 4 * n_dot_v_) * photon_factor(in, l.z));
  value.pdf += density / ((1 + lambda_v) * 4 * n_dot_v_) * reflect_share(c);
}

/// A sheet scatters forward as it reflects.
void Bsdf::thin_lobe(const Vec3& in, BsdfValue& value) const {
  Vec3 l = frame_.to_local(in);
  if (l.z >= 0) return;
  l.z = -l.z;
  Vec3 h = normalize_or(l + local_out_, Vec3(0, 0, 1));
  float c = std::max(glm::dot(local_out_, h), 0.0f);
  float density = ggx_density(h, alpha_);
  float lambda_v = ggx_lambda(local_out_, alpha_), lambda_l = ggx_lambda(l, alpha_);
  Vec3 f = transmitted(c, photons_ ? scales(l.z, eta_).glass : scales_.glass);
  value.f_cos += f * (density / ((1 + lambda_v + lambda_l) * 4 * n_dot_v_) * photon_factor(in, l.z));
  value.pdf += density / ((1 + lambda_v) * 4 * n_dot_v_) * (1 - reflect_share(c));
}

/// Walter et al. 2007, equation 21.
void Bsdf::solid_lobe(const Vec3& in, BsdfValue& value) const {
  Vec3 l = frame_.to_local(in);
  if (l.z >= 0) return;
  Vec3 h = normalize_or(local_out_ + l * eta_, Vec3(0, 0, 1));
  if (h.z < 0) h = -h;
  float c = glm::dot(local_out_, h), d = glm::dot(l, h);
  if (c <= 0 || d >= 0) return;
  float density = ggx_density(h, alpha_);
  float lambda_v = ggx_lambda(local_out_, alpha_), lambda_l = ggx_lambda(l, alpha_);
  float jacobian = density * c * -d / (n_dot_v_ * square(c + eta_ * d));
  Vec3 f = transmitted(c, photons_ ? scales(-l.z, 1 / eta_).glass : scales_.glass);
  float eta2 = eta_ * eta_;
  // Radiance shrinks by eta^2 across the interface; what photons carry does not.
  value.f_cos += f * (jacobian * (photons_ ? eta2 * photon_factor(in, -l.z) : 1.0f) / (1 + lambda_v + lambda_l));
  value.pdf += jacobian * eta2 / (1 + lambda_v) * (1 - reflect_share(c));
}

/// `side`: the cosine with the geometric normal.
void Bsdf::diffuse_lobe(const Vec3& in, float side, BsdfValue& value) const {
  float cosine = glm::dot(in, frame_.n);
  value.pdf += (std::max(cosine, 0.0f) + std::max(glm::dot(folded(in), frame_.n), 0.0f)) * kInvPi;
  float fade, projected; // towards the light, which for photons is behind `out`
  if (photons_) {
    float out_side = std::max(glm::dot(out_, ng_), 1e-4f);
    fade = horizon_fade(out_side, n_dot_v_, ng_dot_n_);
    projected = n_dot_v_ * side / out_side;
    if (cosine <= 0) cosine = 1e-4f; // seen from where the normal would be turned to the viewer
  } else {
    if (cosine <= 0) return;
    fade = horizon_fade(side, cosine, ng_dot_n_);
    projected = cosine;
  }
  float through = 1;
  if (coat_albedo_v_ > 0) {
    float mean = coat_albedo_.mean();
    through = (1 - coat_albedo_v_) * (1 - coat_albedo_.at(cosine)) / (1 - mean);
  }
  value.f_cos += diffuse_ * (kInvPi * projected * fade * diffuse_scale_ * through);
}

BsdfValue Bsdf::evaluate(const Vec3& in, uint8_t lobes) const {
  BsdfValue value;
  float side = glm::dot(in, ng_);
  Probabilities p = probabilities(lobes);
  if (side > 0 && p.diffuse > 0) {
    diffuse_lobe(in, side, value);
    value.pdf *= p.diffuse;
  }
  if (p.facet > 0 && !smooth_ && side != 0) {
    BsdfValue facet;
    auto lobe = side > 0 ? &Bsdf::reflect_lobe : thin_ ? &Bsdf::thin_lobe : &Bsdf::solid_lobe;
    if (side > 0 || glass_ > 0) {
      (this->*lobe)(in, facet);
      // What the bent normal would send to the wrong side.
      if (ng_dot_n_ < 0.99999f) (this->*lobe)(folded(in), facet);
    }
    value.f_cos += facet.f_cos;
    value.pdf += p.facet * facet.pdf;
  }
  value.f_cos *= keep_;
  return value;
}

Vec3 Bsdf::mirror_direction() const {
  Vec3 direction = frame_.n * (2 * glm::dot(out_, frame_.n)) - out_;
  if (glm::dot(direction, ng_) < 0) direction = folded(direction);
  return normalize_or(direction, ng_);
}

Vec3 Bsdf::straight_through() const {
  return thin_ && smooth_ ? keep_ * transmitted(n_dot_v_, scales_.glass) : Vec3(0);
}

Vec3 Bsdf::ambient(const Vec3& around_normal, const Vec3& around_mirror) const {
  Vec3 glossy = glass_ > 0 || smooth_ ? Vec3(0) : reflected(n_dot_v_, {Vec3(metal_), 0, 0}) + coat_ * coat_albedo_v_;
  return diffuse_albedo() * around_normal + keep_ * glossy * around_mirror;
}

/// An ideal mirror or interface: what facets would do whose normals are all alike.
BsdfSample Bsdf::sample_smooth(float probability, float choice) const {
  BsdfSample sample;
  sample.mirror = true;
  sample.valid = true;
  float share = reflect_share(n_dot_v_);
  if (choice < share) {
    sample.direction = mirror_direction();
    sample.weight = keep_ * reflected(n_dot_v_, scales_) / (probability * share);
    return sample;
  }
  sample.weight = keep_ * transmitted(n_dot_v_, scales_.glass) / (probability * (1 - share));
  if (thin_) {
    sample.direction = -out_;
    sample.straight = true;
    return sample;
  }
  Vec3 direction = refracted(out_, frame_.n, n_dot_v_, eta_);
  if (glm::dot(direction, ng_) > 0) direction = folded(direction);
  sample.direction = normalize_or(direction, -ng_);
  if (!photons_) sample.eta2 = eta_ * eta_, sample.weight /= sample.eta2;
  return sample;
}

/// Where a facet chosen by `u` sends light; false where it would have to bounce again.
bool Bsdf::facet_direction(float choice, const Vec2& u, Vec3& direction) const {
  Vec3 h = ggx_sample_visible_normal(local_out_, alpha_, u);
  float c = glm::dot(local_out_, h);
  bool reflects = choice < reflect_share(c);
  Vec3 l = reflects || thin_ ? h * (2 * c) - local_out_ : refracted(local_out_, h, c, eta_);
  if (reflects || thin_ ? l.z <= 0 : l.z >= 0) return false;
  if (!reflects && thin_) l.z = -l.z;
  direction = frame_.to_world(l);
  if ((glm::dot(direction, ng_) < 0) == reflects) direction = folded(direction);
  return true;
}

BsdfSample Bsdf::sample(float choice, const Vec2& u, uint8_t lobes) const {
  BsdfSample sample;
  Probabilities p = probabilities(lobes);
  if (choice < p.mirror) {
    sample.direction = mirror_direction();
    sample.weight = reflectance_ / p.mirror;
    sample.mirror = true;
    sample.valid = true;
    return sample;
  }
  if (choice < p.mirror + p.diffuse) {
    sample.direction = frame_.to_world(sample_cosine_hemisphere(u));
    if (glm::dot(sample.direction, ng_) < 0) sample.direction = folded(sample.direction);
    sample.spread = kDiffuseSpread;
  } else if (p.facet > 0) {
    float within = std::clamp((choice - p.mirror - p.diffuse) / p.facet, 0.0f, 0x1.fffffep-1f);
    if (smooth_) return sample_smooth(p.facet, within);
    if (!facet_direction(within, u, sample.direction)) return sample;
    sample.spread = 0.3f * alpha_;
  } else {
    return sample;
  }
  sample.direction = normalize_or(sample.direction, ng_);
  BsdfValue value = evaluate(sample.direction, lobes);
  if (!(value.pdf > 0)) return sample;
  sample.weight = value.f_cos / value.pdf;
  sample.pdf = value.pdf;
  sample.valid = true;
  if (!photons_ && glm::dot(sample.direction, ng_) < 0 && !thin_) sample.eta2 = eta_ * eta_;
  return sample;
}

} // namespace moonshade::renderer
