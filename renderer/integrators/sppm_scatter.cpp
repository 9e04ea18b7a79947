// Stochastic progressive photon mapping (Hachisuka and Jensen 2009): a path from the camera follows mirrors, glass and
// glossy reflections; where it meets a rough surface it sums the photons of this pass around the point. Direct light is
// sampled as by the path tracer. Radii shrink from pass to pass by a fixed rule (Knaus and Zwicker 2011, "Progressive
// Photon Mapping: A Probabilistic Approach"), so that passes know nothing of each other and any number of them is a
// picture.
#include "renderer/integrators/photon_tracer.h"
#include "renderer/integrators/wavefront.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

/// First radius in pixels' footprints, and its bounds in radii of the scene.
static constexpr float kRadiusPixels = 5, kLeastRadius = 1e-5f, kMostRadius = 0.02f;

void Wavefront::scatter_sppm(const CompiledMaterial& material, size_t begin, size_t end) {
  bool has_lights = scene_.lights->count() > 0;
  for (size_t k = begin; k < end; ++k) {
    uint32_t index = shader_.owner(k);
    Path& path = paths_[index];
    if (end_if_faulted(path, k)) continue;
    SurfaceValues values = shader_.values(k);
    if (passes(path, k, values)) continue;
    absorb(path, material, k, values);
    add_emission(path, material, k, values);
    path.alive = may_bounce(path);
    if (!path.alive) continue;
    Bsdf bsdf = shader_.bsdf(material, k, values);
    uint8_t gathered = gathered_lobes(bsdf), followed = kAllLobes & ~gathered;
    if (has_lights && bsdf.has_extent()) {
      sample_light(path, index, k, bsdf, gathered, false);
      if (bsdf.has_extent(followed)) sample_light(path, index, k, bsdf, followed, true);
    }
    if (bsdf.has_extent(gathered)) path.radiance += path.throughput * gather(path, k, bsdf, gathered);
    path.alive = bsdf.has(followed) && sample_bsdf(path, k, bsdf, followed);
  }
}

/// Radiance to the viewer of light that has bounced before.
Vec3 Wavefront::gather(const Path& path, size_t k, const Bsdf& bsdf, uint8_t lobes) const {
  const ShadedPoint s = shader_.point(k);
  float scene_radius = scene_.geometry->bounds().radius();
  float radius = std::clamp(kRadiusPixels * shader_.width(k), kLeastRadius * scene_radius, kMostRadius * scene_radius) *
                 photons_->radius_scale();
  Vec3 sum(0);
  photons_->near(s.world, radius, [&](const Photon& photon) {
    if (path.bounces + photon.bounces + 2 > settings_.depth) return;
    float cosine = std::abs(glm::dot(photon.towards, s.geometric_normal));
    // Only those that arrived on this very surface: none around corners, none through thin walls.
    if (std::abs(glm::dot(photon.normal, s.geometric_normal)) < 0.7f ||
        std::abs(glm::dot(photon.position - s.world, s.geometric_normal)) > 0.5f * radius)
      return;
    Vec3 f_cos = bsdf.evaluate(photon.towards, lobes).f_cos;
    sum += photon.power * f_cos / std::max(cosine, 0.02f); // photons count per area of the surface itself
  });
  return sum / (kPi * radius * radius * float(photons_->emitted()));
}

} // namespace moonshade::renderer
