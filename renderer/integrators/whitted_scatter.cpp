// Whitted's way, as in the paper: at every point direct light from every light, with shadows; the sky as ambient light,
// without; and one mirror ray where the surface reflects.
#include "renderer/integrators/wavefront.h"

namespace moonshade::renderer {

static constexpr float kLeastReflectance = 1.0f / 512;

void Wavefront::scatter_whitted(const CompiledMaterial& material, size_t begin, size_t end) {
  const LightSet& lights = *scene_.lights;
  for (size_t k = begin; k < end; ++k) {
    uint32_t index = path_of_[k];
    Path& path = paths_[index];
    path.alive = false;
    if (end_if_faulted(path, k)) continue;
    SurfaceValues values = values_at(k);
    if (!(material.emits_outward_only && batch_.backface[k])) path.radiance += path.throughput * values.emission;
    if (path.segments >= settings_.depth) continue;
    Bsdf bsdf = bsdf_at(path, k, values);
    path.radiance += path.throughput * bsdf.ambient(lights.sky_irradiance(points_[k].shading_normal) * kInvPi,
                                                    lights.sky_irradiance(bsdf.mirror_direction()) * kInvPi);
    for (size_t light = 0; light < lights.count(); ++light) {
      if (lights.is_sky(light)) continue;
      uint32_t at = 1 + path.segments * 4096 + uint32_t(light); // as many draws as there are lights
      LightSample sample = lights.sample_light(light, points_[k].world, path.sampler.two(at));
      if (!(sample.pdf > 0) || is_black(sample.radiance)) continue;
      Vec3 f_cos = bsdf.evaluate(sample.direction).f_cos;
      if (!is_black(f_cos)) add_shadow(index, k, sample, path.throughput * f_cos * sample.radiance * (1 / sample.pdf));
    }
    path.throughput *= bsdf.reflectance();
    if (max_component(path.throughput) < kLeastReflectance) continue;
    path.alive = true;
    path.mirror = true;
    follow(path, k, bsdf.mirror_direction(), 0);
  }
}

} // namespace moonshade::renderer
