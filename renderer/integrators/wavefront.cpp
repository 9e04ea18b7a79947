// The loop over bounces, and what both integrators share.
#include "renderer/integrators/wavefront.h"

#include "renderer/sampling/warp.h"

#include <algorithm>

namespace moonshade::renderer {

static const Vec3 kFaultColor(1, 0, 1);

Wavefront::Wavefront(const PreparedScene& scene, size_t capacity)
    : scene_(scene), settings_(scene.scene.settings), camera_(scene.scene.camera, settings_.width, settings_.height),
      batch_(capacity, settings_.time, settings_.frame), paths_(capacity), rays_(capacity), hits_(capacity),
      hit_material_(capacity), path_of_(capacity), hit_of_(capacity), points_(capacity), targets_(capacity),
      blocked_(capacity) {
  active_.reserve(capacity);
  shadow_rays_.reserve(capacity);
  shadows_.reserve(capacity);
  run_start_.resize(scene.materials.size() + 1);
}

void Wavefront::run(const Task& task, const SampleOutputs& out) {
  last_ = thread_seconds();
  first_ = out.first;
  if (first_) std::fill_n(first_, task.pixels.size() * task.samples, FirstHit{});
  generate(task);
  stats_.film_seconds += lap();
  while (!active_.empty()) {
    trace();
    stats_.trace_seconds += lap();
    sort_by_material();
    for (uint32_t material = 0; material < scene_.materials.size(); ++material)
      if (run_start_[material] != run_start_[material + 1])
        shade_run(material, run_start_[material], run_start_[material + 1]);
    std::erase_if(active_, [&](uint32_t index) { return !paths_[index].alive; });
    stats_.shade_seconds += lap();
  }
  deliver(task, out);
  stats_.film_seconds += lap();
}

void Wavefront::generate(const Task& task) {
  active_.clear();
  uint32_t width = uint32_t(settings_.width);
  for (uint32_t pixel : task.pixels)
    for (uint32_t s = 0; s < task.samples; ++s) {
      Path path;
      path.sampler = Sampler(settings_.seed, pixel, task.first_sample + s);
      Vec2 u = path.sampler.two(0);
      float x = float(pixel % width) + 0.5f + sample_tent(u.x), y = float(pixel / width) + 0.5f + sample_tent(u.y);
      path.ray = camera_.ray(x, y);
      path.spread = camera_.spread();
      paths_[active_.size()] = path;
      active_.push_back(uint32_t(active_.size()));
    }
  stats_.paths += active_.size();
}

void Wavefront::trace() {
  for (size_t k = 0; k < active_.size(); ++k)
    rays_[k] = paths_[active_[k]].ray;
  scene_.geometry->closest({rays_.data(), active_.size()}, hits_.data());
  stats_.rays += active_.size();
}

/// What a ray sees that meets nothing.
void Wavefront::leave(Path& path) {
  path.alive = false;
  Vec3 radiance = scene_.lights->environment(path.ray.direction);
  if (is_black(radiance)) return;
  float weight = path.mirror ? 1.0f : power_heuristic(path.pdf, scene_.lights->environment_pdf(path.ray.direction));
  path.radiance += path.throughput * radiance * weight;
}

/// A counting sort; within a material, hits keep the order of their paths.
void Wavefront::sort_by_material() {
  std::fill(run_start_.begin(), run_start_.end(), 0);
  for (size_t k = 0; k < active_.size(); ++k) {
    Path& path = paths_[active_[k]];
    ++path.segments;
    if (!hits_[k].found()) {
      leave(path);
      continue;
    }
    hit_material_[k] = scene_.geometry->objects()[hits_[k].object].material_of(hits_[k].primitive);
    ++run_start_[hit_material_[k] + 1];
  }
  for (size_t m = 1; m < run_start_.size(); ++m)
    run_start_[m] += run_start_[m - 1];
  for (size_t k = 0; k < active_.size(); ++k) {
    if (!hits_[k].found()) continue;
    uint32_t at = run_start_[hit_material_[k]]++;
    path_of_[at] = active_[k];
    hit_of_[at] = hits_[k];
  }
  for (size_t m = run_start_.size() - 1; m > 0; --m)
    run_start_[m] = run_start_[m - 1];
  run_start_[0] = 0;
}

void Wavefront::shade_run(uint32_t index, size_t begin, size_t end) {
  const CompiledMaterial& material = scene_.materials[index];
  for (size_t k = begin; k < end; ++k) {
    Path& path = paths_[path_of_[k]];
    points_[k] = scene_.geometry->surface(path.ray, hit_of_[k]);
    const PlacedObject& placed = scene_.geometry->objects()[hit_of_[k].object];
    path.width += path.spread * points_[k].distance;
    targets_[k] = {&placed, &points_[k], path.width / placed.scale};
    fill_inputs(material.needs, k);
  }
  stats_.shading_points += end - begin;
  double shaders_start = thread_seconds();
  scene_.materials.bend(material, batch_, begin, end - begin, targets_.data() + begin, faults_);
  for (size_t k = begin; k < end; ++k)
    fill_normal(k);
  scene_.materials.shade(material, batch_, begin, end - begin, faults_);
  stats_.shader_seconds += thread_seconds() - shaders_start;
  if (first_) note_first_hits(index, begin, end);
  if (settings_.integrator == IntegratorKind::Path)
    scatter_path(material, begin, end);
  else
    scatter_whitted(material, begin, end);
  trace_shadows();
}

namespace {

void store(ShadingBatch& batch, Channel channel, size_t k, const Vec3& v) {
  for (int c = 0; c < 3; ++c)
    batch.inputs[size_t(channel) + size_t(c)][k] = v[c];
}

constexpr uint32_t mask_of(Channel channel, unsigned components) { return ((1u << components) - 1) << channel; }

} // namespace

/// Whatever the material's shaders read, but for the final normal.
void Wavefront::fill_inputs(uint32_t needs, size_t k) {
  const SurfacePoint& s = points_[k];
  const Vec3& incident = paths_[path_of_[k]].ray.direction;
  bool backface = glm::dot(s.geometric_normal, incident) > 0;
  float side = backface ? -1.0f : 1.0f;
  batch_.backface[k] = backface;
  batch_.id[k] = int64_t(hit_of_[k].object);
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
void Wavefront::fill_normal(size_t k) {
  SurfacePoint& s = points_[k];
  float side = batch_.backface[k] ? -1.0f : 1.0f;
  s.geometric_normal *= side;
  s.shading_normal = turned_to_viewer(s.shading_normal * side, s.geometric_normal, -paths_[path_of_[k]].ray.direction);
  store(batch_, kNormal, k, s.shading_normal);
}

SurfaceValues Wavefront::values_at(size_t k) const {
  auto triple = [&](Slot slot) {
    size_t at = kResultOffset[size_t(slot)];
    return Vec3(batch_.results[at][k], batch_.results[at + 1][k], batch_.results[at + 2][k]);
  };
  auto single = [&](Slot slot) { return batch_.results[kResultOffset[size_t(slot)]][k]; };
  return {triple(Slot::Color),     triple(Slot::Reflectance), triple(Slot::Emission),
          single(Slot::Roughness), single(Slot::Metallic),    single(Slot::Ior)};
}

/// A point without values shows magenta where the camera sees it, and ends the path with nothing anywhere else.
bool Wavefront::end_if_faulted(Path& path, size_t k) {
  if (!batch_.faulted[k]) return false;
  path.alive = false;
  path.faulted = true;
  if (path.segments == 1) path.radiance = kFaultColor;
  return true;
}

Bsdf Wavefront::bsdf_at(const Path& path, size_t k, const SurfaceValues& values) const {
  return Bsdf(values, points_[k].shading_normal, points_[k].geometric_normal, -path.ray.direction);
}

void Wavefront::follow(Path& path, size_t k, const Vec3& direction, float spread) {
  const SurfacePoint& s = points_[k];
  path.ray = {s.world + s.geometric_normal * s.offset, 0, direction, kInfinity};
  path.spread += spread;
}

void Wavefront::add_shadow(uint32_t path, size_t k, const LightSample& light, const Vec3& contribution) {
  if (shadows_.size() == shadows_.capacity()) trace_shadows();
  const SurfacePoint& s = points_[k];
  // The end stops short of the light's own surface.
  float far = light.distance == kInfinity ? kInfinity : light.distance * (1 - 1e-4f) - s.offset;
  shadow_rays_.push_back({s.world + s.geometric_normal * s.offset, 0, light.direction, far});
  shadows_.push_back({path, contribution});
}

void Wavefront::trace_shadows() {
  if (shadows_.empty()) return;
  stats_.shade_seconds += lap();
  scene_.geometry->occluded(shadow_rays_, blocked_.data());
  stats_.rays += shadows_.size();
  stats_.trace_seconds += lap();
  for (size_t k = 0; k < shadows_.size(); ++k)
    if (!blocked_[k]) paths_[shadows_[k].path].radiance += shadows_[k].contribution;
  shadow_rays_.clear();
  shadows_.clear();
}

/// What paths see that have just left the camera. Paths are numbered as the task's samples are.
void Wavefront::note_first_hits(uint32_t material, size_t begin, size_t end) {
  for (size_t k = begin; k < end; ++k) {
    if (paths_[path_of_[k]].segments != 1) continue;
    const SurfacePoint& s = points_[k];
    SurfaceValues values = values_at(k);
    Vec3 albedo = values.color * (Vec3(1) - values.reflectance) + values.reflectance;
    if (batch_.faulted[k]) albedo = kFaultColor;
    first_[path_of_[k]] = {albedo,      s.shading_normal, s.world, camera_.depth(s.world), hit_of_[k].object + 1,
                           material + 1};
  }
}

void Wavefront::deliver(const Task& task, const SampleOutputs& out) {
  size_t count = task.pixels.size() * task.samples;
  for (size_t k = 0; k < count; ++k) {
    Vec3 value = paths_[k].radiance;
    if (!is_finite(value)) {
      ++faults_[{"", "radiance", kNotFinite, 0, ""}];
      value = Vec3(0);
      paths_[k].faulted = true;
    }
    float brightest = max_component(value);
    if (settings_.clamp > 0 && brightest > settings_.clamp) value *= settings_.clamp / brightest;
    out.radiance[k] = value;
    if (out.faulted) out.faulted[k] = paths_[k].faulted;
  }
}

} // namespace moonshade::renderer
