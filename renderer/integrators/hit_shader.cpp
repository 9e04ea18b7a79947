#include "renderer/integrators/hit_shader.h"

#include "renderer/materials/bump.h"
#include "renderer/materials/diffuse.h"

namespace moonshade::renderer {

HitShader::HitShader(const Scene& scene, const Geometry& geometry, const MaterialSet& materials, size_t capacity)
    : geometry_(geometry), materials_(materials), kernels_(kernels()),
      batch_(capacity, scene.settings.time, scene.settings.frame), sorted_(capacity), material_(capacity),
      run_start_(materials.size() + 1) {
  added_.reserve(capacity);
  for (std::vector<float>* array : {&distance_, &offset_, &width_, &outward_[0], &outward_[1], &outward_[2]})
    array->resize(capacity + kLanes);
  for (size_t c = 0; c < std::size(arrays_.inputs); ++c)
    arrays_.inputs[c] = batch_.inputs[c].data();
  arrays_.backface = batch_.backface.data();
  arrays_.id = batch_.id.data();
  arrays_.distance = distance_.data(), arrays_.offset = offset_.data(), arrays_.width = width_.data();
  for (int c = 0; c < 3; ++c)
    arrays_.outward[c] = outward_[c].data();
}

/// Asks for what the corners of a triangle have; its indices are there since the hit was added.
static void fetch(const float* values, const uint32_t* indices, uint32_t triangle) {
  for (size_t corner = 0; corner < 3; ++corner)
    __builtin_prefetch(values + size_t(indices[size_t(triangle) * 3 + corner]) * 3);
}

/// A counting sort, which also asks for the corners that are soon needed: they lie anywhere in memory.
void HitShader::sort() {
  std::fill(run_start_.begin(), run_start_.end(), 0);
  const TriangleSource* sources = geometry_.sources().data();
  for (size_t k = 0; k < added_.size(); ++k) {
    const Hit& hit = added_[k].hit;
    const TriangleSource& source = sources[hit.object];
    material_[k] = source.material_of(hit.primitive);
    ++run_start_[material_[k] + 1];
    if (source.vertices) fetch(source.vertices, source.triangles, hit.primitive);
    if (source.normals) fetch(source.normals, source.normal_corners, hit.primitive);
  }
  one_run_ = added_.empty() || run_start_[material_[0] + 1] == added_.size();
  for (size_t m = 1; m < run_start_.size(); ++m)
    run_start_[m] += run_start_[m - 1];
  if (one_run_) return;
  for (size_t k = 0; k < added_.size(); ++k)
    sorted_[run_start_[material_[k]]++] = added_[k];
  for (size_t m = run_start_.size() - 1; m > 0; --m)
    run_start_[m] = run_start_[m - 1];
  run_start_[0] = 0;
}

void HitShader::shade_run(const CompiledMaterial& material, size_t begin, size_t end, FaultLog& faults,
                          WorkerStats& stats) {
  shown_ = &material;
  bool bends = material.bends();
  place(material.needs, bends, begin, end);
  stats.shading_points += end - begin;
  auto clear_faults = [&] { std::fill_n(batch_.faulted.begin() + long(begin), end - begin, uint8_t(0)); };
  if (!material.has_shaders()) return clear_faults();
  double start = thread_seconds();
  if (bends) bend_normals(material, batch_, begin, end - begin, {geometry_, met() + begin, arrays_}, faults);
  clear_faults(); // those of `height` do not count
  materials_.shade(material, batch_, begin, end - begin, faults);
  stats.shader_seconds += thread_seconds() - start;
}

/// Whatever the material's shaders and the integrators read of points.
void HitShader::place(uint32_t needs, bool bends, size_t begin, size_t end) {
  const TriangleSource* sources = geometry_.sources().data();
  for (size_t at = begin; at < end; at += kLanes) {
    size_t count = std::min(kLanes, end - at);
    const Met* block = met() + at;
    bool triangles = std::all_of(block, block + count, [&](const Met& m) { return sources[m.hit.object].vertices; });
    if (triangles)
      kernels_.triangle_points(sources, block, count, needs, bends, arrays_, at);
    else
      for (size_t k = at; k < at + count; ++k)
        place_one(needs, bends, k);
  }
}

static void store(const PointArrays& arrays, Channel channel, size_t k, const Vec3& v) {
  for (int c = 0; c < 3; ++c)
    arrays.inputs[size_t(channel) + size_t(c)][k] = v[c];
}

/// What the kernel does for triangles, for a point of anything.
void HitShader::place_one(uint32_t needs, bool bends, size_t k) {
  const Met& met = this->met()[k];
  SurfacePoint s = geometry_.surface(*met.ray, met.hit);
  const Vec3& incident = met.ray->direction;
  width_[k] = met.width + met.spread * s.distance;
  bool backface = glm::dot(s.geometric_normal, incident) > 0;
  float side = backface ? -1.0f : 1.0f;
  batch_.backface[k] = backface;
  batch_.id[k] = int64_t(met.hit.object);
  Vec3 geometric = s.geometric_normal * side, shading = s.shading_normal * side;
  store(arrays_, kWorld, k, s.world);
  store(arrays_, kGeometric, k, geometric);
  distance_[k] = s.distance, offset_[k] = s.offset;
  for (int c = 0; c < 3; ++c)
    outward_[c][k] = s.shading_normal[c];
  store(arrays_, kNormal, k, bends ? shading : turned_to_viewer(shading, geometric, -incident));
  if (needs == 0 && !bends) return;
  store(arrays_, kLocal, k, s.local);
  store(arrays_, kIncident, k, incident);
  batch_.inputs[kUv][k] = s.uv.x, batch_.inputs[kUv + 1][k] = s.uv.y;
  store(arrays_, kDpdu, k, s.dpdu);
  store(arrays_, kDpdv, k, s.dpdv);
  batch_.inputs[kFootprint][k] = width_[k] / geometry_.objects()[met.hit.object].scale;
}

SurfaceValues HitShader::values(size_t k) const {
  const CompiledMaterial& m = *shown_;
  auto triple = [&](Slot slot) {
    if (!m.calls[size_t(slot)]) return m.constants[size_t(slot)];
    return Vec3(results(slot, 0)[k], results(slot, 1)[k], results(slot, 2)[k]);
  };
  auto single = [&](Slot slot) { return m.calls[size_t(slot)] ? results(slot, 0)[k] : m.constants[size_t(slot)].x; };
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
