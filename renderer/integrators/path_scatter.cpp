// Path tracing: at every vertex one light sample and one BSDF sample, weighed by the power heuristic; Russian roulette
// by the throughput from the fifth segment on. A path has at most Settings::depth segments. What a surface does to the
// path that meets it goes point by point, what it scatters 16 points at once.
#include "renderer/integrators/wavefront.h"

#include <cstring>

namespace moonshade::renderer {

void Wavefront::scatter_path(const CompiledMaterial& material, size_t begin, size_t end) {
  bool only_scatters = !material.emits() && !material.may_differ(Slot::Opacity, 1) && is_black(material.absorption);
  BlockMaterial scattering = block_material(material);
  size_t points[kLanes], count = 0;
  for (size_t k = begin; k < end; ++k) {
    Path& path = paths_[shader_.owner(k)];
    if (end_if_faulted(path, k)) continue;
    if (!only_scatters) {
      SurfaceValues values = shader_.values(k);
      if (passes(path, k, values)) continue;
      absorb(path, material, k, values);
      add_emission(path, material, k, values);
    }
    path.alive = may_bounce(path);
    if (!path.alive) continue;
    points[count++] = k;
    if (count < kLanes) continue;
    scatter_block(scattering, points, count);
    count = 0;
  }
  if (count > 0) scatter_block(scattering, points, count);
}

static SurfaceKinds kinds_of(const CompiledMaterial& m) {
  float roughness = m.constants[size_t(Slot::Roughness)].x;
  return {.metal = m.may_differ(Slot::Metallic, 0),
          .coat = m.may_differ(Slot::Metallic, 1) && m.may_differ(Slot::Transmission, 1) && m.may_differ(Slot::Ior, 1),
          .glass = m.may_differ(Slot::Transmission, 0),
          .rough = m.calls[size_t(Slot::Roughness)] || !(roughness * roughness < kSmoothAlpha),
          .thin = m.thin};
}

/// What the kernels need of a material. Slots that are constants are in the block from here on.
Wavefront::BlockMaterial Wavefront::block_material(const CompiledMaterial& m) {
  BlockMaterial result{m.only_diffuse(), m.thin, albedo_tables(albedo_needs(kinds_of(m))), {}};
  auto slot = [&](Slot which, int component, LaneFloats& lanes) {
    if (m.calls[size_t(which)])
      result.shaded.push_back({shader_.results(which, component), &lanes});
    else
      std::fill_n(lanes, kLanes, m.constants[size_t(which)][component]);
  };
  for (int c = 0; c < 3; ++c)
    slot(Slot::Color, c, block_.color[c]), slot(Slot::Reflectance, c, block_.reflectance[c]);
  slot(Slot::Roughness, 0, block_.roughness), slot(Slot::Metallic, 0, block_.metallic);
  slot(Slot::Ior, 0, block_.ior), slot(Slot::Transmission, 0, block_.transmission);
  return result;
}

/// Of an array of points, those of a block: mostly they follow each other.
static void load(LaneFloats& lanes, const float* from, const size_t* points, size_t count) {
  if (count == kLanes && points[kLanes - 1] - points[0] == kLanes - 1)
    std::memcpy(lanes, from + points[0], sizeof lanes);
  else
    for (size_t i = 0; i < kLanes; ++i)
      lanes[i] = from[points[i < count ? i : 0]];
}

void Wavefront::load_block(const BlockMaterial& material, const size_t* points, size_t count) {
  ScatterBlock& b = block_;
  const PointArrays& from = shader_.arrays();
  for (size_t c = 0; c < 3; ++c) {
    load(b.point[c], from.inputs[kWorld + c], points, count);
    load(b.normal[c], from.inputs[kNormal + c], points, count);
    load(b.geometric[c], from.inputs[kGeometric + c], points, count);
  }
  for (const auto& [results, lanes] : material.shaded)
    load(*lanes, results, points, count);
  load(b.offset, from.offset, points, count);
  load(b.width, from.width, points, count);
  for (size_t i = 0; i < kLanes; ++i) {
    size_t point = points[i < count ? i : 0];
    b.owner[i] = shader_.owner(point);
    b.paths[i] = &paths_[b.owner[i]];
    b.backface[i] = from.backface[point];
  }
}

void Wavefront::scatter_block(const BlockMaterial& material, const size_t* points, size_t count) {
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
  if (material.only_diffuse)
    kernels_.scatter_diffuse(b, material.albedos);
  else
    kernels_.scatter(b, material.albedos, material.thin);
  for (size_t i = 0; i < count; ++i)
    if (b.straight[i]) go_straight(*b.paths[i], points[i]);
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
