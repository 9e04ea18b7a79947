// A preview: direct light as the path tracer samples it, mirrors and glass followed, and indirect light on everything
// rougher from the cache.
#include "renderer/integrators/irradiance_cache.h"
#include "renderer/integrators/photon_tracer.h"
#include "renderer/integrators/wavefront.h"

namespace moonshade::renderer {

void Wavefront::scatter_irradiance(const CompiledMaterial& material, size_t begin, size_t end) {
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
    uint8_t looked_up = gathered_lobes(bsdf), followed = kAllLobes & ~looked_up;
    if (has_lights && bsdf.has_extent()) {
      sample_light(path, index, k, bsdf, looked_up, false);
      if (bsdf.has_extent(followed)) sample_light(path, index, k, bsdf, followed, true);
    }
    if (bsdf.has_extent(looked_up)) {
      const ShadedPoint s = shader_.point(k);
      Vec3 around = cache_->at(s.world, s.geometric_normal, shader_.width(k)) * kInvPi;
      path.radiance += path.throughput * bsdf.ambient(around, looked_up & kFacetLobe ? around : Vec3(0));
    }
    path.alive = bsdf.has(followed) && sample_bsdf(path, k, bsdf, followed);
  }
}

} // namespace moonshade::renderer
