// Path tracing: at every vertex one light sample and one BSDF sample, weighed by the power heuristic; Russian roulette
// by the throughput from the fifth segment on. A path has at most Settings::depth segments.
#include "renderer/integrators/wavefront.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

static constexpr uint32_t kRouletteFrom = 5;

void Wavefront::scatter_path(const CompiledMaterial& material, size_t begin, size_t end) {
  bool has_lights = scene_.lights->count() > 0;
  for (size_t k = begin; k < end; ++k) {
    uint32_t index = path_of_[k];
    Path& path = paths_[index];
    if (end_if_faulted(path, k)) continue;
    SurfaceValues values = values_at(k);
    bool shines = !(material.emits_outward_only && batch_.backface[k]);
    if (shines && !is_black(values.emission)) {
      const SurfacePoint& s = points_[k];
      float weight = 1;
      if (!path.mirror) {
        float pdf = scene_.lights->object_pdf(hit_of_[k].object, hit_of_[k].primitive, path.ray.origin,
                                              path.ray.direction, s.distance, s.geometric_normal);
        weight = power_heuristic(path.pdf, pdf);
      }
      path.radiance += path.throughput * values.emission * weight;
    }
    if (path.segments >= settings_.depth) {
      path.alive = false;
      continue;
    }
    Bsdf bsdf = bsdf_at(path, k, values);
    if (has_lights && bsdf.has_extent()) sample_light(path, index, k, bsdf);
    path.alive = sample_bsdf(path, k, bsdf);
  }
}

void Wavefront::sample_light(Path& path, uint32_t index, size_t k, const Bsdf& bsdf) {
  LightSample light = scene_.lights->sample(points_[k].world, path.sampler.one(dimension(path, kLightChoice)),
                                            path.sampler.two(dimension(path, kLightPoint)));
  if (!(light.pdf > 0) || is_black(light.radiance)) return;
  BsdfValue value = bsdf.evaluate(light.direction);
  if (is_black(value.f_cos)) return;
  float weight = light.delta ? 1.0f : power_heuristic(light.pdf, value.pdf);
  add_shadow(index, k, light, path.throughput * value.f_cos * light.radiance * (weight / light.pdf));
}

/// The next direction; false where the path ends.
bool Wavefront::sample_bsdf(Path& path, size_t k, const Bsdf& bsdf) {
  BsdfSample next =
      bsdf.sample(path.sampler.one(dimension(path, kLobe)), path.sampler.two(dimension(path, kDirection)));
  if (!next.valid) return false;
  path.throughput *= next.weight;
  float brightest = max_component(path.throughput);
  if (!(brightest > 0)) return false;
  if (path.segments >= kRouletteFrom) {
    float survival = std::min(0.95f, brightest);
    if (path.sampler.one(dimension(path, kRoulette)) >= survival) return false;
    path.throughput /= survival;
  }
  path.pdf = next.pdf;
  path.mirror = next.mirror;
  follow(path, k, next.direction, next.spread);
  return true;
}

} // namespace moonshade::renderer
