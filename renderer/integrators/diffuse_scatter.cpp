// Path tracing on surfaces that only scatter diffusely: what path_scatter.cpp does there, 16 points at once.
#include "renderer/integrators/wavefront.h"

namespace moonshade::renderer {

void Wavefront::scatter_diffuse(const CompiledMaterial& material, size_t begin, size_t end) {
  size_t points[kLanes], count = 0;
  for (size_t k = begin; k < end; ++k) {
    Path& path = paths_[shader_.owner(k)];
    if (end_if_faulted(path, k)) continue;
    path.alive = may_bounce(path);
    if (!path.alive) continue;
    points[count++] = k;
    if (count < kLanes) continue;
    scatter_block(material, points, count);
    count = 0;
  }
  if (count > 0) scatter_block(material, points, count);
}

/// Points and paths side by side; lanes beyond the last repeat the first.
void Wavefront::load_block(const CompiledMaterial& material, const size_t* points, size_t count) {
  ScatterBlock& b = block_;
  const PointArrays& from = shader_.arrays();
  bool shaded = material.calls[size_t(Slot::Color)].has_value();
  const Vec3& color = material.constants[size_t(Slot::Color)];
  for (size_t i = 0; i < kLanes; ++i) {
    size_t k = points[i < count ? i : 0];
    const Path& path = paths_[shader_.owner(k)];
    for (size_t c = 0; c < 3; ++c) {
      b.point[c][i] = from.inputs[kWorld + c][k];
      b.normal[c][i] = from.inputs[kNormal + c][k];
      b.geometric[c][i] = from.inputs[kGeometric + c][k];
      b.color[c][i] = shaded ? shader_.results(Slot::Color, int(c))[k] : color[int(c)];
    }
    b.throughput[0][i] = path.throughput.x, b.throughput[1][i] = path.throughput.y;
    b.throughput[2][i] = path.throughput.z;
    b.eta2[i] = path.eta2;
    b.segments[i] = path.segments, b.bounces[i] = path.bounces;
    b.key[i] = path.sampler.draws().key, b.sample[i] = path.sampler.draws().sample;
    float between =
        b.geometric[0][i] * b.normal[0][i] + b.geometric[1][i] * b.normal[1][i] + b.geometric[2][i] * b.normal[2][i];
    b.scale[i] = between < kNormalsAgree ? 1 / horizon_albedo(between) : 1.0f;
  }
}

void Wavefront::scatter_block(const CompiledMaterial& material, const size_t* points, size_t count) {
  ScatterBlock& b = block_;
  const LightSet& lights = *scene_.lights;
  load_block(material, points, count);
  kernels_.draw_vertices(b, uint32_t(lights.count()));
  if (lights.count()) {
    lights.look_up(b, count, block_lights_);
    kernels_.sample_lights(b, lights.formulas().data(), lights.formulas().size(), float(lights.count()));
  } else {
    std::fill_n(b.light_pdf, kLanes, 0.0f);
  }
  kernels_.scatter_diffuse(b);
  for (size_t i = 0; i < count; ++i) {
    size_t k = points[i];
    uint32_t index = shader_.owner(k);
    Path& path = paths_[index];
    if (b.lit[i]) {
      LightSample& light = block_lights_[i];
      light.direction = {b.to_light[0][i], b.to_light[1][i], b.to_light[2][i]};
      light.distance = b.light_distance[i];
      add_shadow(index, k, light, {b.contribution[0][i], b.contribution[1][i], b.contribution[2][i]});
    }
    path.alive = b.survives[i];
    if (!path.alive) continue;
    path.throughput = {b.throughput[0][i], b.throughput[1][i], b.throughput[2][i]};
    path.pdf = b.pdf[i];
    path.mirror = false;
    follow(path, k, {b.direction[0][i], b.direction[1][i], b.direction[2][i]}, kDiffuseSpread);
  }
}

} // namespace moonshade::renderer
