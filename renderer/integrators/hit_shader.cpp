#include "renderer/integrators/hit_shader.h"

namespace moonshade::renderer {

HitShader::HitShader(const Scene& scene, const Geometry& geometry, const MaterialSet& materials, size_t capacity)
    : geometry_(geometry), materials_(materials), batch_(capacity, scene.settings.time, scene.settings.frame),
      met_(capacity), material_(capacity), run_start_(materials.size() + 1), points_(capacity), targets_(capacity) {
  added_.reserve(capacity);
}

/// A counting sort.
void HitShader::sort() {
  std::fill(run_start_.begin(), run_start_.end(), 0);
  for (size_t k = 0; k < added_.size(); ++k) {
    material_[k] = geometry_.objects()[added_[k].hit.object].material_of(added_[k].hit.primitive);
    ++run_start_[material_[k] + 1];
  }
  for (size_t m = 1; m < run_start_.size(); ++m)
    run_start_[m] += run_start_[m - 1];
  for (size_t k = 0; k < added_.size(); ++k)
    met_[run_start_[material_[k]]++] = added_[k];
  for (size_t m = run_start_.size() - 1; m > 0; --m)
    run_start_[m] = run_start_[m - 1];
  run_start_[0] = 0;
}

void HitShader::shade_run(const CompiledMaterial& material, size_t begin, size_t end, FaultLog& faults,
                          WorkerStats& stats) {
  for (size_t k = begin; k < end; ++k) {
    Met& met = met_[k];
    points_[k] = geometry_.surface(*met.ray, met.hit);
    const PlacedObject& placed = geometry_.objects()[met.hit.object];
    met.width += met.spread * points_[k].distance;
    targets_[k] = {&placed, &points_[k], met.width / placed.scale};
    fill_inputs(material.needs, k);
  }
  stats.shading_points += end - begin;
  double start = thread_seconds();
  materials_.bend(material, batch_, begin, end - begin, targets_.data() + begin, faults);
  for (size_t k = begin; k < end; ++k)
    fill_normal(k);
  materials_.shade(material, batch_, begin, end - begin, faults);
  stats.shader_seconds += thread_seconds() - start;
}

namespace {

void store(ShadingBatch& batch, Channel channel, size_t k, const Vec3& v) {
  for (int c = 0; c < 3; ++c)
    batch.inputs[size_t(channel) + size_t(c)][k] = v[c];
}

constexpr uint32_t mask_of(Channel channel, unsigned components) { return ((1u << components) - 1) << channel; }

} // namespace

/// Whatever the material's shaders read, but for the final normal.
void HitShader::fill_inputs(uint32_t needs, size_t k) {
  const SurfacePoint& s = points_[k];
  const Vec3& incident = met_[k].ray->direction;
  bool backface = glm::dot(s.geometric_normal, incident) > 0;
  float side = backface ? -1.0f : 1.0f;
  batch_.backface[k] = backface;
  batch_.id[k] = int64_t(met_[k].hit.object);
  if (needs == 0) return;
  store(batch_, kLocal, k, s.local);
  store(batch_, kWorld, k, s.world);
  store(batch_, kNormal, k, s.shading_normal * side);
  if (needs & mask_of(kGeometric, 3)) store(batch_, kGeometric, k, s.geometric_normal * side);
  if (needs & mask_of(kIncident, 3)) store(batch_, kIncident, k, incident);
  if (needs & mask_of(kUv, 2)) batch_.inputs[kUv][k] = s.uv.x, batch_.inputs[kUv + 1][k] = s.uv.y;
  if (needs & mask_of(kDpdu, 3)) store(batch_, kDpdu, k, s.dpdu);
  if (needs & mask_of(kDpdv, 3)) store(batch_, kDpdv, k, s.dpdv);
  batch_.inputs[kFootprint][k] = targets_[k].footprint;
}

/// Both normals towards the viewer, from here on; the shading normal is the bumped one.
void HitShader::fill_normal(size_t k) {
  SurfacePoint& s = points_[k];
  float side = batch_.backface[k] ? -1.0f : 1.0f;
  s.geometric_normal *= side;
  s.shading_normal = turned_to_viewer(s.shading_normal * side, s.geometric_normal, -met_[k].ray->direction);
  store(batch_, kNormal, k, s.shading_normal);
}

SurfaceValues HitShader::values(size_t k) const {
  auto triple = [&](Slot slot) {
    size_t at = kResultOffset[size_t(slot)];
    return Vec3(batch_.results[at][k], batch_.results[at + 1][k], batch_.results[at + 2][k]);
  };
  auto single = [&](Slot slot) { return batch_.results[kResultOffset[size_t(slot)]][k]; };
  return {triple(Slot::Color),    triple(Slot::Reflectance), triple(Slot::Emission),     single(Slot::Roughness),
          single(Slot::Metallic), single(Slot::Ior),         single(Slot::Transmission), single(Slot::Opacity)};
}

Vec3 HitShader::straight_through(const CompiledMaterial& material, size_t k) const {
  if (batch_.faulted[k]) return Vec3(0);
  SurfaceValues v = values(k);
  Vec3 through(1 - v.opacity);
  if (material.thin && v.opacity > 0 && v.transmission > 0)
    through += v.opacity * bsdf(material, k, v).straight_through();
  return through;
}

} // namespace moonshade::renderer
