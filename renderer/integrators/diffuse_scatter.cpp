// Path tracing on surfaces that only scatter diffusely: what path_scatter.cpp does there, 16 points at once.
#include "renderer/integrators/wavefront.h"

#include <cstring>

namespace moonshade::renderer {

void Wavefront::scatter_diffuse(const CompiledMaterial& material, size_t begin, size_t end) {
  size_t points[kLanes], count = 0;
  for (size_t k = begin; k < end; ++k) {
    Path& path = paths_[shader_.owner(k)];
    if (end_if_faulted(path, k)) continue;
    if (!may_bounce(path)) {
      path.alive = false;
      continue;
    }
    points[count++] = k;
    if (count < kLanes) continue;
    scatter_block(material, points, count);
    count = 0;
  }
  if (count > 0) scatter_block(material, points, count);
}

/// Of an array of points, those of a block: mostly they follow each other.
static void load(LaneFloats& lanes, const float* from, const size_t* points, size_t count) {
  if (count == kLanes && points[kLanes - 1] - points[0] == kLanes - 1)
    std::memcpy(lanes, from + points[0], sizeof lanes);
  else
    for (size_t i = 0; i < kLanes; ++i)
      lanes[i] = from[points[i < count ? i : 0]];
}

void Wavefront::load_block(const CompiledMaterial& material, const size_t* points, size_t count) {
  ScatterBlock& b = block_;
  const PointArrays& from = shader_.arrays();
  bool shaded = material.calls[size_t(Slot::Color)].has_value();
  const Vec3& color = material.constants[size_t(Slot::Color)];
  for (size_t c = 0; c < 3; ++c) {
    load(b.point[c], from.inputs[kWorld + c], points, count);
    load(b.normal[c], from.inputs[kNormal + c], points, count);
    load(b.geometric[c], from.inputs[kGeometric + c], points, count);
    if (shaded)
      load(b.color[c], shader_.results(Slot::Color, int(c)), points, count);
    else
      std::fill_n(b.color[c], kLanes, color[int(c)]);
  }
  load(b.offset, from.offset, points, count);
  load(b.width, from.width, points, count);
  for (size_t i = 0; i < kLanes; ++i) {
    b.owner[i] = shader_.owner(points[i < count ? i : 0]);
    b.paths[i] = &paths_[b.owner[i]];
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
  add_shadows(count);
}

/// Those of the block.
void Wavefront::add_shadows(size_t count) {
  const ScatterBlock& b = block_;
  if (!shadows_.wants_details()) {
    if (shadows_.room() < count) trace_shadows();
    return shadows_.add(b.shadows, b.lit, count);
  }
  for (size_t i = 0; i < count; ++i) {
    if (!b.lit[i]) continue;
    block_lights_[i].distance = b.light_distance[i];
    add_shadow(b.shadows[i], block_lights_[i], b.width[i], b.spread[i]);
  }
}

} // namespace moonshade::renderer
