// How a surface scatters light; docs/materials.md has the same as formulas:
//
//     f = (1 - R) [ metallic M + (1 - metallic) ( (1 - transmission) (C + D) + transmission T ) ] + R mirror
//
// R = reflectance (the paper's reflect shader); M a metal and C a dielectric coat over the diffuse D; T glass, solid or
// thin. M, C and T are microfacet lobes with GGX and alpha = roughness^2, scaled for light that bounces more than once
// between facets (Turquin 2019); D fills up what the coat leaves, so that white surfaces lose nothing. Below
// kSmoothAlpha they are ideal: one direction, which no light sampling finds.
//
// Shading normals differ from geometric ones (smooth meshes, bump mapping). A specular direction on the wrong side of
// the geometric surface is folded back (the density folds with it), so that bumps show no black spots; diffuse light
// fades towards the geometric horizon (Chiang et al. 2019, "Taming the Shadow Terminator") and is scaled by what that
// takes on average.
#pragma once

#include "renderer/materials/bsdf_lanes.h"

namespace moonshade::renderer {

/// diffuse.h's, of one normal.
Vec3 turned_to_viewer(const Vec3& normal, const Vec3& geometric_normal, const Vec3& out);

/// Values of one point's slots, in range.
struct SurfaceValues {
  Vec3 color{0.8f}, reflectance{0}, emission{0};
  float roughness = 0.5f, metallic = 0, ior = 1.5f, transmission = 0, opacity = 1;
};

/// Of which side of what kind of surface, and of what is carried: radiance to a camera, or importance's dual, photons.
struct SurfaceSide {
  bool backface = false; ///< within a solid, looking out
  bool thin = false;
  bool photons = false; ///< `out` leads to where they come from
};

struct BsdfSample {
  Vec3 direction{0};
  Vec3 weight{0};        ///< f · cos / pdf
  float pdf = 0;         ///< of the lobes with extent; 0 for the mirror
  bool mirror = false;   ///< from a lobe without extent
  bool straight = false; ///< through a thin sheet, unbent: the path goes on as if nothing were there
  bool valid = false;
  float spread = 0; ///< how much wider the footprint grows per distance
  float eta2 = 1;   ///< by which square of indices `weight` was divided at an interface
};

struct BsdfValue {
  Vec3 f_cos{0};
  float pdf = 0;
};

/// Of one point: the formulas are bsdf_lanes.h's.
class Bsdf {
public:
  /// All vectors unit; both normals face the viewer `out` (turned_to_viewer).
  Bsdf(const SurfaceValues& values, const Vec3& shading_normal, const Vec3& geometric_normal, const Vec3& out,
       SurfaceSide side = {});

  /// f times the cosine, and the density of `sample` from the same lobes, without those that have no extent.
  BsdfValue evaluate(const Vec3& in, uint8_t lobes = kAllLobes) const;
  BsdfSample sample(float choice, const Vec2& u, uint8_t lobes = kAllLobes) const;

  /// The mirror's direction, on the viewer's side of the surface.
  Vec3 mirror_direction() const;
  /// Light that goes straight through: of a smooth thin sheet.
  Vec3 straight_through() const;
  /// Ambient light reflected to the viewer: `around_normal` and `around_mirror` are mean radiances from there.
  Vec3 ambient(const Vec3& around_normal, const Vec3& around_mirror) const;
  /// The diffuse part's colour, weakened by what the coat reflects towards the viewer.
  Vec3 diffuse_albedo() const;

  bool has_extent(uint8_t lobes = kAllLobes) const {
    lanes::Bsdf<float>::Lobes p = lanes_.probabilities(lobes);
    return p.diffuse > 0 || (p.facet > 0 && !smooth());
  }
  bool has(uint8_t lobes) const {
    lanes::Bsdf<float>::Lobes p = lanes_.probabilities(lobes);
    return p.diffuse + p.facet + p.mirror > 0;
  }
  bool smooth() const { return lanes_.smooth.bits; }
  bool transmits() const { return lanes_.any_glass; }
  float alpha() const { return lanes_.alpha; }

private:
  lanes::Bsdf<float> lanes_;
};

} // namespace moonshade::renderer
