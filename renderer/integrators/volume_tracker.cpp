#include "renderer/integrators/volume_tracker.h"

#include "renderer/integrators/hit_shader.h"

namespace moonshade::renderer {

static constexpr uint32_t kMostCollisions = 1u << 17; // of one way

VolumeTracker::VolumeTracker(const PreparedScene& scene, VolumeControls& controls, size_t capacity)
    : scene_(scene), controls_(controls), capacity_(capacity),
      batch_(capacity, scene.scene.settings.time, scene.scene.settings.frame), control_(capacity), failed_(capacity) {
  active_.reserve(capacity_);
  real_.reserve(capacity_);
}

const CompiledMaterial& VolumeTracker::material_of(uint32_t object) const {
  return scene_.materials[scene_.geometry->objects()[object].object->materials[0]];
}

/// Amanatides and Woo 1987.
void VolumeTracker::begin(Flight& f) const {
  const PlacedObject& placed = scene_.geometry->objects()[f.object];
  const Volume& volume = *scene_.volumes->of(f.object);
  f.local = Vec3(placed.to_object * glm::dvec4(DVec3(f.ray.origin), 1.0));
  f.step = Vec3(placed.to_object * glm::dvec4(DVec3(f.ray.direction), 0.0));
  f.scale = glm::length(f.step);
  f.at = 0, f.drawn = 0;
  for (int c = 0; c < 3; ++c) {
    float place = (f.local[c] - volume.low[c]) / volume.cell[c];
    f.cell[c] = std::clamp(int(std::floor(std::clamp(place, -1.0f, float(volume.size[c])))), 0, volume.size[c] - 1);
    f.turn[c] = f.step[c] > 0 ? 1 : -1;
    if (f.step[c] == 0) {
      f.next[c] = f.every[c] = kInfinity;
      continue;
    }
    float border = volume.low[c] + volume.cell[c] * float(f.cell[c] + (f.turn[c] > 0 ? 1 : 0));
    f.next[c] = std::max((border - f.local[c]) / f.step[c], 0.0f);
    f.every[c] = volume.cell[c] / std::abs(f.step[c]);
  }
}

/// To the next tentative collision; false where the way ends first.
bool VolumeTracker::advance(Flight& f, float& control) const {
  const Volume& volume = *scene_.volumes->of(f.object);
  float u = f.sampler.one(2 * f.drawn);
  float depth = -std::log(1 - u);
  for (;;) {
    int axis = f.next[0] <= f.next[1] && f.next[0] <= f.next[2] ? 0 : f.next[1] <= f.next[2] ? 1 : 2;
    float end = std::min(f.next[axis], f.ray.far);
    control = controls_.at(f.object, volume.index(f.cell));
    float thickness = control * f.scale * std::max(end - f.at, 0.0f);
    if (depth < thickness) {
      f.at += depth / (control * f.scale);
      return true;
    }
    depth -= thickness;
    f.at = std::max(f.at, end);
    if (!(f.next[axis] < f.ray.far)) return false;
    f.next[axis] += f.every[axis];
    f.cell[axis] += f.turn[axis];
    if (f.cell[axis] < 0 || f.cell[axis] >= volume.size[axis]) {
      // Past the grid: by no more than rounding.
      f.cell[axis] -= f.turn[axis];
      f.next[axis] = kInfinity;
    }
  }
}

void VolumeTracker::run(std::vector<Flight>& flights, Mode mode, FaultLog& faults, WorkerStats& stats) {
  if (flights.empty()) return;
  double start = thread_seconds();
  active_.clear();
  for (uint32_t k = 0; k < flights.size(); ++k) {
    begin(flights[k]);
    active_.push_back(k);
  }
  // Volumes one after the other, so that a call has one shader.
  std::sort(active_.begin(), active_.end(),
            [&](uint32_t a, uint32_t b) { return std::pair(flights[a].object, a) < std::pair(flights[b].object, b); });
  while (!active_.empty()) {
    size_t left = 0;
    for (uint32_t index : active_)
      if (advance(flights[index], control_[left])) active_[left++] = index;
    active_.resize(left);
    stats.shading_points += left;
    for (size_t begin = 0, end; begin < left; begin = end) {
      uint32_t object = flights[active_[begin]].object;
      for (end = begin; end < left && flights[active_[end]].object == object;)
        ++end;
      look(flights, begin, end, mode, faults);
    }
    std::erase_if(active_,
                  [&](uint32_t k) { return flights[k].collided || flights[k].faulted || flights[k].weight == 0; });
  }
  stats.shader_seconds += thread_seconds() - start;
}

void VolumeTracker::call(const EntryCall& entry, size_t count, unsigned components, size_t result, FaultLog& faults) {
  uint8_t* codes = batch_.scratch_codes.data();
  std::fill_n(codes, count, uint8_t(0));
  float* out[3];
  for (unsigned c = 0; c < components; ++c)
    out[c] = batch_.results[result + c].data();
  FaultReport report;
  entry.run(batch_, 0, count, EntryCall::inputs_of(batch_, 0), out, codes, report);
  for (size_t k = 0; k < count; ++k)
    failed_[k] |= codes[k] != 0;
  if (std::any_of(codes, codes + count, [](uint8_t code) { return code != 0; }))
    note_faults(entry, codes, count, report, faults);
}

/// What is at the tentative collisions of active flights [begin, end), all in one volume.
void VolumeTracker::look(std::vector<Flight>& flights, size_t begin, size_t end, Mode mode, FaultLog& faults) {
  const CompiledMaterial& material = material_of(flights[active_[begin]].object);
  const VolumeCalls& volume = *material.volume;
  const Volume& grid = *scene_.volumes->of(flights[active_[begin]].object);
  size_t count = end - begin;
  auto fill = [&](size_t k, const Flight& f) {
    fill_volume_inputs(batch_, k, f.local + f.step * f.at, f.ray.origin + f.ray.direction * f.at, f.ray.direction,
                       (f.width + f.spread * f.at) * f.scale, f.object);
  };
  for (size_t k = 0; k < count; ++k)
    fill(k, flights[active_[begin + k]]);
  std::fill_n(failed_.begin(), count, uint8_t(0));
  if (volume.density)
    call(*volume.density, count, 1, 0, faults);
  else
    std::fill_n(batch_.results[0].data(), count, volume.density_constant);
  bool glows = mode != Mode::Transmittance && volume.glows();
  if (glows && volume.emission) call(*volume.emission, count, 3, 1, faults);
  real_.clear();
  for (size_t k = 0; k < count; ++k) {
    Flight& f = flights[active_[begin + k]];
    if (failed_[k] || ++f.drawn > kMostCollisions) {
      f.faulted = true;
      continue;
    }
    float density = std::max(batch_.results[0][k], 0.0f), control = control_[begin + k];
    if (density > control) controls_.note(f.object, grid.index(f.cell), density);
    if (glows) {
      f.glow += emitted_at(volume, k) * (f.weight / control);
    }
    if (mode != Mode::Distance) {
      f.weight *= 1 - density / control;
      // Roulette: what hardly arrives is not followed for ever.
      if (std::abs(f.weight) < 0.05f) f.weight = f.sampler.one(2 * f.drawn - 1) < 0.5f ? 2 * f.weight : 0;
      continue;
    }
    float other = std::abs(control - density), all = density + other;
    if (f.sampler.one(2 * f.drawn - 1) * all < density) {
      f.weight *= all / control;
      f.collided = true;
      f.distance = f.at;
      real_.push_back(active_[begin + k]);
    } else {
      f.weight *= (control >= density ? all : -all) / control;
    }
  }
  for (size_t k = 0; k < real_.size(); ++k)
    fill(k, flights[real_[k]]);
  if (!real_.empty()) collide(flights, material, faults);
}

Vec3 VolumeTracker::emitted_at(const VolumeCalls& volume, size_t k) const {
  if (!volume.emission) return volume.emission_constant;
  return glm::max(Vec3(batch_.results[1][k], batch_.results[2][k], batch_.results[3][k]), Vec3(0));
}

void VolumeTracker::emission(uint32_t object, std::span<const Vec3> points, Vec3* emitted, FaultLog& faults,
                             WorkerStats& stats) {
  const VolumeCalls& volume = *material_of(object).volume;
  const PlacedObject& placed = scene_.geometry->objects()[object];
  for (size_t k = 0; k < points.size(); ++k)
    fill_volume_inputs(batch_, k, Vec3(placed.to_object * glm::dvec4(DVec3(points[k]), 1.0)), points[k], Vec3(0, 0, 1),
                       0, object);
  std::fill_n(failed_.begin(), points.size(), uint8_t(0));
  if (volume.emission) call(*volume.emission, points.size(), 3, 1, faults);
  for (size_t k = 0; k < points.size(); ++k)
    emitted[k] = failed_[k] ? Vec3(0) : emitted_at(volume, k);
  stats.shading_points += points.size();
}

void VolumeTracker::collide(std::vector<Flight>& flights, const CompiledMaterial& material, FaultLog& faults) {
  const VolumeCalls& volume = *material.volume;
  size_t count = real_.size();
  std::fill_n(failed_.begin(), count, uint8_t(0));
  if (volume.color) call(*volume.color, count, 3, 0, faults);
  if (volume.anisotropy) call(*volume.anisotropy, count, 1, 3, faults);
  for (size_t k = 0; k < count; ++k) {
    Flight& f = flights[real_[k]];
    f.faulted |= failed_[k] != 0;
    f.albedo = volume.color
                   ? glm::clamp(Vec3(batch_.results[0][k], batch_.results[1][k], batch_.results[2][k]), 0.0f, 1.0f)
                   : volume.color_constant;
    f.anisotropy = std::clamp(volume.anisotropy ? batch_.results[3][k] : volume.anisotropy_constant, -0.98f, 0.98f);
  }
}

} // namespace moonshade::renderer
