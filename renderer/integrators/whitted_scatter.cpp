// Whitted's way, as in the paper: at every point direct light from every light, with shadows; the sky as ambient light,
// without; and one ray onwards where the surface is a mirror or glass, into one of the directions it sends light to.
#include "renderer/integrators/wavefront.h"

namespace moonshade::renderer {

static constexpr float kLeastReflectance = 1.0f / 512;

void Wavefront::scatter_whitted(const CompiledMaterial& material, size_t begin, size_t end) {
  const LightSet& lights = *scene_.lights;
  for (size_t k = begin; k < end; ++k) {
    uint32_t index = shader_.owner(k);
    Path& path = paths_[index];
    path.alive = false;
    if (end_if_faulted(path, k)) continue;
    SurfaceValues values = shader_.values(k);
    if (passes(path, k, values)) continue;
    absorb(path, material, k, values);
    if (!(material.emits_outward_only && shader_.backface(k))) path.radiance += path.throughput * values.emission;
    if (!may_bounce(path)) continue;
    Bsdf bsdf = shader_.bsdf(material, k, values);
    const ShadedPoint s = shader_.point(k);
    path.radiance += path.throughput * bsdf.ambient(lights.sky_irradiance(s.shading_normal) * kInvPi,
                                                    lights.sky_irradiance(bsdf.mirror_direction()) * kInvPi);
    uint8_t onwards = kMirrorLobe | (bsdf.smooth() || bsdf.transmits() ? kFacetLobe : 0);
    for (size_t light = 0; light < lights.count(); ++light) {
      if (lights.is_sky(light)) continue;
      uint32_t at = 1 + path.segments * 4096 + uint32_t(light); // as many draws as there are lights
      LightSample sample = lights.sample_light(light, s.world, path.sampler.two(at), path.sampler.fork(at).one(0));
      if (!(sample.pdf > 0) || is_black(sample.radiance)) continue;
      Vec3 f_cos = bsdf.evaluate(sample.direction, kAllLobes & ~onwards).f_cos;
      if (!is_black(f_cos)) add_shadow(index, k, sample, path.throughput * f_cos * sample.radiance * (1 / sample.pdf));
    }
    if (!bsdf.has(onwards)) continue;
    BsdfSample next =
        bsdf.sample(path.sampler.one(dimension(path, kLobe)), path.sampler.two(dimension(path, kDirection)), onwards);
    path.throughput *= next.weight;
    if (!next.valid || max_component(path.throughput) < kLeastReflectance) continue;
    path.alive = true;
    path.mirror = true;
    if (next.straight)
      go_straight(path, k);
    else
      follow(path, k, next.direction, next.spread);
  }
}

} // namespace moonshade::renderer
