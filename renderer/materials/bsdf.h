// How a surface scatters light:
//
//     f = (1 - R) [ (1 - metallic) diffuse + GGX ] + R mirror
//
// R = reflectance (the paper's reflect shader); diffuse = color / pi, weakened by what the coat reflects on the way in
// and out; GGX with alpha = roughness^2, height-correlated Smith masking and Schlick's Fresnel, at normal incidence
// ((ior - 1) / (ior + 1))^2, or `color` for metals, scaled for light that bounces more than once between facets.
//
// Shading normals differ from geometric ones (smooth meshes, bump mapping). A specular direction below the geometric
// surface is folded back to its side (the density folds with it), so that bumps show no black spots; diffuse light
// fades towards the geometric horizon (Chiang et al. 2019, "Taming the Shadow Terminator").
#pragma once

#include "renderer/math.h"

namespace moonshade::renderer {

/// The shading normal, turned just enough for the viewer in direction `out` to see its front; one that equals the
/// geometric normal stays.
Vec3 turned_to_viewer(const Vec3& normal, const Vec3& geometric_normal, const Vec3& out);

/// Values of one point's slots, in range.
struct SurfaceValues {
  Vec3 color{0.8f}, reflectance{0}, emission{0};
  float roughness = 0.5f, metallic = 0, ior = 1.5f;
};

struct BsdfSample {
  Vec3 direction{0};
  Vec3 weight{0}; ///< f · cos / pdf
  float pdf = 0;  ///< of the lobes with extent; 0 for the mirror
  bool mirror = false;
  bool valid = false;
  float spread = 0; ///< how much wider the footprint grows per distance
};

struct BsdfValue {
  Vec3 f_cos{0};
  float pdf = 0;
};

class Bsdf {
public:
  /// All vectors unit; both normals face the viewer `out`. The shading normal is turned just enough for the viewer to
  /// see its front.
  Bsdf(const SurfaceValues& values, const Vec3& shading_normal, const Vec3& geometric_normal, const Vec3& out);

  /// f times the cosine, and the density of `sample`, without the mirror.
  BsdfValue evaluate(const Vec3& in) const;
  BsdfSample sample(float choice, const Vec2& u) const;

  /// The mirror's direction, on the viewer's side of the surface.
  Vec3 mirror_direction() const;
  const Vec3& reflectance() const { return reflectance_; }
  /// Ambient light reflected to the viewer: `around_normal` and `around_mirror` are mean radiances from there.
  Vec3 ambient(const Vec3& around_normal, const Vec3& around_mirror) const {
    Vec3 glossy = f0_ + (Vec3(f90_) - f0_) * schlick_power(n_dot_v_);
    Vec3 diffuse = diffuse_ * (1 - fresnel(n_dot_v_, f0_dielectric_));
    return (Vec3(1) - reflectance_) * (diffuse * around_normal + glossy * around_mirror);
  }
  bool has_extent() const { return diffuse_probability_ + glossy_probability_ > 0; }

private:
  static float schlick_power(float cosine) {
    float m = std::clamp(1 - cosine, 0.0f, 1.0f), m2 = m * m;
    return m2 * m2 * m;
  }
  static float fresnel(float cosine, float f0);
  float glossy_pdf_and_value(const Vec3& in, Vec3& f_cos) const;
  Vec3 folded(const Vec3& direction) const { return direction - ng_ * (2 * glm::dot(direction, ng_)); }

  Frame frame_;
  Vec3 ng_, out_, local_out_;
  Vec3 reflectance_, diffuse_, f0_, compensation_;
  float f0_dielectric_, f90_, alpha_, n_dot_v_;
  float mirror_probability_ = 0, diffuse_probability_ = 0, glossy_probability_ = 0;
};

} // namespace moonshade::renderer
