#include "renderer/volumes/volume_set.h"

#include "renderer/geometry/float_environment.h"
#include "renderer/lights/endless.h"
#include "renderer/sampling/sampler.h"

namespace moonshade::renderer {

namespace {

constexpr int kCells = 48; ///< along the longest side
constexpr int kEach = 64;  ///< points looked at in a cell
constexpr int kEachGlow = 32;
constexpr float kLeast = 4e-3f; ///< of the greatest control: none is zero where a shader may be greater

/// Looks at points of every cell of a grid over a volume's box, `each` of them, and calls visit(cell, results) for
/// each; a fault counts as nothing here and is met again while rendering.
class Meter {
public:
  /// `endless` counts over all meters.
  Meter(const Scene& scene, const PlacedObject& placed, uint32_t id, const Vec3& low, const Vec3& cell, const int* size,
        uint64_t& endless)
      : placed_(placed), id_(id), low_(low), cell_(cell), size_(size), endless_(endless),
        batch_(kBatch, scene.settings.time, scene.settings.frame) {}

  template <typename Visit> void look(const EntryCall& entry, uint32_t each, Visit visit) {
    for (size_t cell = 0; cell < cell_count(size_) && endless_ < kMostEndless; ++cell)
      for (uint32_t k = 0; k < each; ++k) {
        Sampler sampler(11, uint32_t(cell), k);
        Vec3 local = low_ + cell_ * (cell_corner(cell, size_) + Vec3(sampler.two(0), sampler.one(1)));
        Vec3 world = Vec3(placed_.object->to_world * Vec4(local, 1));
        fill_volume_inputs(batch_, cells_.size(), local, world, Vec3(0, 0, 1), 0, id_);
        cells_.push_back(cell);
        if (cells_.size() == kBatch) flush(entry, visit);
      }
    flush(entry, visit);
  }

private:
  static constexpr size_t kBatch = 4096;

  template <typename Visit> void flush(const EntryCall& entry, Visit visit) {
    std::fill_n(batch_.scratch_codes.data(), cells_.size(), uint8_t(0));
    float* out[3];
    for (size_t c = 0; c < 3; ++c)
      out[c] = batch_.results[c].data();
    FaultReport ignored;
    entry.run(batch_, 0, cells_.size(), EntryCall::inputs_of(batch_, 0), out, batch_.scratch_codes.data(), ignored);
    endless_ +=
        uint64_t(std::count(batch_.scratch_codes.begin(), batch_.scratch_codes.begin() + std::ptrdiff_t(cells_.size()),
                            uint8_t(FaultCode::StepLimit)));
    for (size_t k = 0; k < cells_.size(); ++k)
      visit(cells_[k], Vec3(out[0][k], out[1][k], out[2][k]));
    cells_.clear();
  }

  const PlacedObject& placed_;
  uint32_t id_;
  Vec3 low_, cell_;
  const int* size_;
  uint64_t& endless_;
  ShadingBatch batch_;
  std::vector<size_t> cells_;
};

/// As many cells as there are `most` along the longest side, all nearly cubes.
void divide(const Vec3& extent, int most, int* size) {
  float side = max_component(extent) / float(most);
  for (int c = 0; c < 3; ++c)
    size[c] = std::clamp(int(std::ceil(extent[c] / side)), 1, most);
}

/// Null where nothing glows.
std::unique_ptr<GlowGrid> make_glow(const Scene& scene, const PlacedObject& placed, uint32_t id,
                                    const VolumeCalls& calls, const Vec3& low, const Vec3& extent, uint64_t& endless) {
  if (!calls.glows()) return nullptr;
  int size[3];
  divide(extent, GlowGrid::kCells, size);
  size_t count = cell_count(size);
  std::vector<float> brightness(count, luminance(calls.emission_constant));
  if (calls.emission) {
    std::vector<double> sums(count, 0.0);
    Vec3 cell(extent.x / float(size[0]), extent.y / float(size[1]), extent.z / float(size[2]));
    Meter meter(scene, placed, id, low, cell, size, endless);
    meter.look(*calls.emission, kEachGlow, [&](size_t at, const Vec3& emission) {
      sums[at] += double(std::max(luminance(glm::max(emission, Vec3(0))), 0.0f));
    });
    double all = 0;
    for (double sum : sums)
      all += sum;
    // A share of the mean everywhere: points may be brighter than what was seen of their cell.
    double floor = 0.05 * all / double(count);
    for (size_t k = 0; k < count; ++k)
      brightness[k] = float((sums[k] + floor) / kEachGlow);
  }
  // Of a sphere, cells of the corners hold nothing.
  if (placed.object->shape == Shape::Sphere)
    for (size_t k = 0; k < count; ++k) {
      Vec3 cell = extent / Vec3(size[0], size[1], size[2]), a = low + cell * cell_corner(k, size), b = a + cell;
      if (glm::length(glm::clamp(Vec3(0), a, b)) > placed.object->radius) brightness[k] = 0;
    }
  double all = 0;
  for (float b : brightness)
    all += double(b);
  if (!(all > 0) || !std::isfinite(all)) return nullptr;
  return std::make_unique<GlowGrid>(placed, low, extent, size, brightness);
}

std::unique_ptr<Volume> make_volume(const Scene& scene, const PlacedObject& placed, uint32_t id,
                                    const VolumeCalls& calls, uint64_t& endless) {
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
  divide(extent, kCells, volume->size);
  for (int c = 0; c < 3; ++c)
    volume->cell[c] = extent[c] / float(volume->size[c]);
  volume->low = box.low;
  const int* n = volume->size;
  std::vector<float> greatest(cell_count(n), calls.density_constant);
  if (calls.density)
    Meter(scene, placed, id, volume->low, volume->cell, n, endless)
        .look(*calls.density, kEach,
              [&](size_t cell, const Vec3& result) { greatest[cell] = std::max(greatest[cell], result.x); });
  // The neighbours' too: maxima lie between the points.
  float all = *std::max_element(greatest.begin(), greatest.end());
  float least = calls.glows() ? std::max(all * kLeast, 16 / max_component(extent)) // glow is found where light collides
                              : all * kLeast;
  volume->controls.resize(greatest.size());
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        float most = 0;
        for (int k = 0; k < 27; ++k) {
          const int at[] = {std::clamp(x + k % 3 - 1, 0, n[0] - 1), std::clamp(y + k / 3 % 3 - 1, 0, n[1] - 1),
                            std::clamp(z + k / 9 - 1, 0, n[2] - 1)};
          most = std::max(most, greatest[cell_index(at, n)]);
        }
        const int here[] = {x, y, z};
        volume->controls[cell_index(here, n)] = std::max(Volume::kSafety * most, least);
      }
  volume->glow = make_glow(scene, placed, id, calls, box.low, extent, endless);
  return volume;
}

} // namespace

void fill_volume_inputs(ShadingBatch& batch, size_t k, const Vec3& local, const Vec3& world, const Vec3& direction,
                        float footprint, uint32_t object) {
  for (int c = 0; c < 3; ++c) {
    batch.inputs[size_t(kLocal) + size_t(c)][k] = local[c];
    batch.inputs[size_t(kWorld) + size_t(c)][k] = world[c];
    batch.inputs[size_t(kIncident) + size_t(c)][k] = direction[c];
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
  uint64_t endless = 0;
  for (uint32_t id = 0; id < volumes_.size(); ++id) {
    const PlacedObject& placed = geometry.objects()[id];
    const CompiledMaterial& material = materials[placed.object->materials[0]];
    if (!material.volume) continue;
    volumes_[id] = make_volume(scene, placed, id, *material.volume, endless);
    any_ = true;
  }
}

} // namespace moonshade::renderer
