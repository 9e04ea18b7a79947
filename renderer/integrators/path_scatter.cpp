// Path tracing: at every vertex one light sample and one BSDF sample, weighed by the power heuristic; Russian roulette
// by the throughput from the fifth segment on. A path has at most Settings::depth segments. diffuse_scatter.cpp does
// the same, many points at once, for materials that can be nothing but diffuse.
#include "renderer/integrators/wavefront.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

void Wavefront::scatter_path(const CompiledMaterial& material, size_t begin, size_t end) {
  if (material.only_diffuse()) return scatter_diffuse(material, begin, end);
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
    if (has_lights && bsdf.has_extent()) sample_light(path, index, k, bsdf, kAllLobes, true);
    path.alive = sample_bsdf(path, k, bsdf, kAllLobes);
  }
}

/// Of a surface that the path's ray has met.
void Wavefront::add_emission(Path& path, const CompiledMaterial& material, size_t k, const SurfaceValues& values) {
  if (is_black(values.emission) || (material.emits_outward_only && shader_.backface(k))) return;
  float weight = 1;
  if (!path.mirror) {
    const ShadedPoint s = shader_.point(k);
    const Hit& hit = shader_.hit(k);
    float pdf = scene_.lights->object_pdf(hit.object, hit.primitive, path.from, path.ray.direction,
                                          path.travelled + s.distance, s.geometric_normal);
    weight = power_heuristic(path.pdf, pdf);
  }
  path.radiance += path.throughput * values.emission * weight;
}

/// `both_ways`: the directions that the lobes are sampled by find lights, too.
void Wavefront::sample_light(Path& path, uint32_t index, size_t k, const Bsdf& bsdf, uint8_t lobes, bool both_ways) {
  LightSample light = scene_.lights->sample(shader_.point(k).world, path.sampler.one(dimension(path, kLightChoice)),
                                            path.sampler.two(dimension(path, kLightPoint)));
  if (!(light.pdf > 0) || is_black(light.radiance)) return;
  BsdfValue value = bsdf.evaluate(light.direction, lobes);
  if (is_black(value.f_cos)) return;
  float weight = light.delta || !both_ways ? 1.0f : power_heuristic(light.pdf, value.pdf);
  add_shadow(index, k, light, path.throughput * value.f_cos * light.radiance * (weight / light.pdf));
}

/// The next direction; false where the path ends.
bool Wavefront::sample_bsdf(Path& path, size_t k, const Bsdf& bsdf, uint8_t lobes) {
  BsdfSample next =
      bsdf.sample(path.sampler.one(dimension(path, kLobe)), path.sampler.two(dimension(path, kDirection)), lobes);
  if (!next.valid) return false;
  path.throughput *= next.weight;
  path.eta2 *= next.eta2;
  if (!survives(path)) return false;
  if (next.straight) {
    go_straight(path, k);
    return path.alive;
  }
  path.pdf = next.pdf;
  path.mirror = next.mirror;
  follow(path, k, next.direction, next.spread);
  return true;
}

} // namespace moonshade::renderer
