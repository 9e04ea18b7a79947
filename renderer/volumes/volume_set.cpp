#include "renderer/volumes/volume_set.h"

#include "renderer/geometry/float_environment.h"
#include "renderer/sampling/sampler.h"

namespace moonshade::renderer {

namespace {

constexpr int kCells = 48; ///< along the longest side
constexpr int kEach = 64;  ///< points looked at in a cell
constexpr float kSafety = 1.25f;
constexpr float kLeast = 4e-3f; ///< of the greatest control: none is zero where a shader may be greater

/// The density at points of every cell; a fault counts as nothing here and is met again while rendering.
std::vector<float> measure(const Scene& scene, const PlacedObject& placed, uint32_t id,
                           const CompiledMaterial& material, const Volume& volume) {
  size_t count = size_t(volume.size[0]) * size_t(volume.size[1]) * size_t(volume.size[2]);
  std::vector<float> greatest(count, material.volume->density_constant);
  if (!material.volume->density) return greatest;
  constexpr size_t kBatch = 4096;
  ShadingBatch batch(kBatch, scene.settings.time, scene.settings.frame);
  std::vector<size_t> cells;
  FaultReport ignored;
  auto flush = [&] {
    std::fill_n(batch.scratch_codes.data(), cells.size(), uint8_t(0));
    float* out[1] = {batch.results[0].data()};
    material.volume->density->run(batch, 0, cells.size(), EntryCall::inputs_of(batch, 0), out,
                                  batch.scratch_codes.data(), ignored);
    for (size_t k = 0; k < cells.size(); ++k)
      greatest[cells[k]] = std::max(greatest[cells[k]], out[0][k]);
    cells.clear();
  };
  for (size_t cell = 0; cell < count; ++cell)
    for (uint32_t k = 0; k < kEach; ++k) {
      Sampler sampler(11, uint32_t(cell), k);
      size_t row = cell / size_t(volume.size[0]);
      Vec3 at(float(cell % size_t(volume.size[0])), float(row % size_t(volume.size[1])),
              float(row / size_t(volume.size[1])));
      Vec3 local = volume.low + volume.cell * (at + Vec3(sampler.two(0), sampler.one(1)));
      Vec3 world = Vec3(placed.object->to_world * Vec4(local, 1));
      fill_volume_inputs(batch, cells.size(), local, world, Vec3(0, 0, 1), 0, id);
      cells.push_back(cell);
      if (cells.size() == kBatch) flush();
    }
  flush();
  return greatest;
}

std::unique_ptr<Volume> make_volume(const Scene& scene, const PlacedObject& placed, uint32_t id,
                                    const CompiledMaterial& material) {
  auto volume = std::make_unique<Volume>();
  Box box;
  if (placed.object->shape == Shape::Sphere) {
    box.add(Vec3(-placed.object->radius)), box.add(Vec3(placed.object->radius));
  } else {
    for (const Vec3& p : placed.object->mesh->positions)
      if (is_finite(p)) box.add(p);
  }
  if (box.empty()) box.add(Vec3(0));
  Vec3 extent = glm::max(box.high - box.low, Vec3(1e-6f));
  box.low -= extent * 1e-4f, extent *= 1 + 2e-4f;
  float side = max_component(extent) / kCells;
  for (int c = 0; c < 3; ++c) {
    volume->size[c] = std::clamp(int(std::ceil(extent[c] / side)), 1, kCells);
    volume->cell[c] = extent[c] / float(volume->size[c]);
  }
  volume->low = box.low;
  std::vector<float> greatest = measure(scene, placed, id, material, *volume);
  // The neighbours' too: maxima lie between the points.
  float all = *std::max_element(greatest.begin(), greatest.end());
  float least = material.volume->glows()
                    ? std::max(all * kLeast, 4 / max_component(extent)) // glow is found where light collides
                    : all * kLeast;
  const int* n = volume->size;
  volume->controls.resize(greatest.size());
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        float most = 0;
        for (int k = 0; k < 27; ++k) {
          int i = std::clamp(x + k % 3 - 1, 0, n[0] - 1), j = std::clamp(y + k / 3 % 3 - 1, 0, n[1] - 1),
              l = std::clamp(z + k / 9 - 1, 0, n[2] - 1);
          most = std::max(most, greatest[size_t((l * n[1] + j) * n[0] + i)]);
        }
        volume->controls[size_t((z * n[1] + y) * n[0] + x)] = std::max(kSafety * most, least);
      }
  return volume;
}

} // namespace

void fill_volume_inputs(ShadingBatch& batch, size_t k, const Vec3& local, const Vec3& world, const Vec3& direction,
                        float footprint, uint32_t object) {
  for (int c = 0; c < 3; ++c) {
    batch.inputs[size_t(kLocal + c)][k] = local[c];
    batch.inputs[size_t(kWorld + c)][k] = world[c];
    batch.inputs[size_t(kIncident + c)][k] = direction[c];
  }
  batch.inputs[kFootprint][k] = footprint;
  batch.id[k] = int64_t(object);
}

Media media_at(const Geometry& geometry, const VolumeSet& volumes, const Vec3& point) {
  Media media;
  if (!volumes.any()) return media;
  std::vector<uint32_t> entered;
  Ray ray{point, 0, glm::normalize(Vec3(0.31f, 0.89f, 0.17f)), kInfinity};
  for (int surface = 0; surface < 256; ++surface) {
    Hit hit;
    geometry.closest({&ray, 1}, &hit);
    if (!hit.found()) break;
    SurfacePoint s = geometry.surface(ray, hit);
    float along = glm::dot(s.geometric_normal, ray.direction);
    if (volumes.of(hit.object)) {
      auto found = std::find(entered.begin(), entered.end(), hit.object);
      if (along < 0)
        entered.push_back(hit.object);
      else if (found != entered.end())
        entered.erase(found);
      else
        media.cross(hit.object, true);
    }
    ray.origin = s.world + s.geometric_normal * (along < 0 ? -s.offset : s.offset);
  }
  return media;
}

void VolumeSet::multiply_controls(float factor) {
  for (const auto& volume : volumes_)
    if (volume)
      for (float& control : volume->controls)
        control *= factor;
}

VolumeSet::VolumeSet(const Scene& scene, const Geometry& geometry, const MaterialSet& materials)
    : volumes_(scene.objects.size()) {
  DefaultFloatEnvironment environment;
  for (uint32_t id = 0; id < volumes_.size(); ++id) {
    const PlacedObject& placed = geometry.objects()[id];
    const CompiledMaterial& material = materials[placed.object->materials[0]];
    if (!material.volume) continue;
    volumes_[id] = make_volume(scene, placed, id, material);
    any_ = true;
  }
}

} // namespace moonshade::renderer
