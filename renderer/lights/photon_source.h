// Photons leaving lights. Lights are chosen by their power; light from far away and from points is aimed, for the
// greater part, at what the camera sees.
#pragma once

#include "renderer/lights/light_set.h"
#include "renderer/sampling/sampler.h"

namespace moonshade::renderer {

struct EmittedPhoton {
  Ray ray;
  Vec3 power{0}; ///< divided by its density; black: none
  /// Where not Known, still to be multiplied by what is emitted along the ray.
  Emitter emitter = Emitter::Known;
  uint32_t object = 0, primitive = 0; ///< Surface, Volume: the ray begins on it, within it
};

class PhotonSource {
public:
  /// All outlive this. `focus` is a sphere around what the camera sees.
  PhotonSource(const Geometry& geometry, const LightSet& lights, const Vec3& focus, float focus_radius);

  /// Draws the dimensions below kDimensions.
  EmittedPhoton emit(const Sampler& sampler) const;
  static constexpr uint32_t kDimensions = 4;

private:
  EmittedPhoton from_far(const Vec3& to_light, const Vec2& u, float choice) const;
  EmittedPhoton from_point(const LightSet::Entry& entry, const Vec2& u, float choice) const;
  EmittedPhoton from_volume(const LightSet::Entry& entry, const Vec2& at, float w, const Vec2& u) const;
  EmittedPhoton from_surface(const LightSet::Entry& entry, const Vec2& at, const Vec2& u, float choice) const;
  float power_of(const LightSet::Entry& entry) const;
  float far_pdf(const Vec3& to_light) const;

  const Geometry& geometry_;
  const LightSet& lights_;
  Vec3 focus_, center_;
  float focus_radius_, radius_;
  std::vector<float> cumulative_;
};

} // namespace moonshade::renderer
