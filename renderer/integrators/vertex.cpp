// A vertex of a path, point by point: emission for all integrators, and for those that look up photons or irradiance
// what path_scatter.cpp does in blocks.
#include "renderer/integrators/wavefront.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

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
