// Hits of a batch of rays, shaded: sorted by material, their points computed, and each material's shaders called once
// for all its points. Whoever traced the rays adds the hits and is then shown one material after the other.
#pragma once

#include "renderer/integrators/task.h"
#include "renderer/kernels/kernels.h"
#include "renderer/materials/bsdf.h"
#include "renderer/materials/material_set.h"

#include <ctime>
#include <vector>

namespace moonshade::renderer {

/// What this thread has run so far; waiting for a core does not count. (A call of the system: not for every point.)
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// What integrators ask of a shaded point. Both normals are turned to the viewer.
struct ShadedPoint {
  Vec3 world, geometric_normal, shading_normal;
  float distance; ///< along the ray
  float offset;   ///< how far a ray must start from the surface not to meet it again
};

class HitShader {
public:
  /// All outlive this; `capacity` is the most hits at a time.
  HitShader(const Scene& scene, const Geometry& geometry, const MaterialSet& materials, size_t capacity);

  void clear() { added_.clear(); }
  /// The ray stays where it is until its hit has been shown. The footprint is `width` wide at its origin and grows by
  /// `spread` per distance.
  void add(uint32_t owner, const Ray& ray, const Hit& hit, float width, float spread) {
    added_.push_back({owner, width, spread, &ray, hit});
    const TriangleSource& source = geometry_.sources()[hit.object];
    if (source.vertices) __builtin_prefetch(source.triangles + size_t(hit.primitive) * 3);
    if (source.normals) __builtin_prefetch(source.normal_corners + size_t(hit.primitive) * 3);
  }

  /// Shades everything added; calls visit(material, begin, end) for each material's points [begin, end), of which
  /// everything below can be asked until it returns.
  template <typename Visit> void shade(FaultLog& faults, WorkerStats& stats, Visit visit) {
    sort();
    for (uint32_t material = 0; material < materials_.size(); ++material) {
      size_t begin = run_start_[material], end = run_start_[material + 1];
      if (begin == end) continue;
      shade_run(materials_[material], begin, end, faults, stats);
      visit(materials_[material], begin, end);
    }
  }

  uint32_t owner(size_t k) const { return met()[k].owner; }
  const Hit& hit(size_t k) const { return met()[k].hit; }
  const Ray& ray(size_t k) const { return *met()[k].ray; }
  /// Of the footprint at the point, in world units.
  float width(size_t k) const { return width_[k]; }
  ShadedPoint point(size_t k) const {
    return {vector(kWorld, k), vector(kGeometric, k), vector(kNormal, k), distance_[k], offset_[k]};
  }
  bool backface(size_t k) const { return batch_.backface[k]; }
  bool faulted(size_t k) const { return batch_.faulted[k]; }
  SurfaceValues values(size_t k) const;
  Bsdf bsdf(const CompiledMaterial& material, size_t k, const SurfaceValues& values, bool photons = false) const {
    return Bsdf(values, vector(kNormal, k), vector(kGeometric, k), -ray(k).direction,
                {bool(batch_.backface[k]), material.thin, photons});
  }
  /// Share of light that passes straight on.
  Vec3 straight_through(const CompiledMaterial& material, size_t k) const;

  /// Where `point` comes from, and the values of a slot that a shader gives.
  const PointArrays& arrays() const { return arrays_; }
  const float* results(Slot slot, int component) const {
    return batch_.results[size_t(kResultOffset[size_t(slot)]) + size_t(component)].data();
  }

private:
  void sort();
  void shade_run(const CompiledMaterial& material, size_t begin, size_t end, FaultLog& faults, WorkerStats& stats);
  void place(uint32_t needs, bool bends, size_t begin, size_t end);
  void place_one(uint32_t needs, bool bends, size_t k);
  Vec3 vector(Channel channel, size_t k) const {
    return {batch_.inputs[channel][k], batch_.inputs[size_t(channel) + 1][k], batch_.inputs[size_t(channel) + 2][k]};
  }
  const Met* met() const { return one_run_ ? added_.data() : sorted_.data(); }

  const Geometry& geometry_;
  const MaterialSet& materials_;
  const Kernels& kernels_;
  ShadingBatch batch_;
  std::vector<float> distance_, offset_, width_, outward_[3];
  PointArrays arrays_;
  std::vector<Met> added_, sorted_; ///< as added; sorted by material, within which they keep their order
  bool one_run_ = false;            ///< of one material all: `added_` is sorted already
  std::vector<uint32_t> material_, run_start_;
  const CompiledMaterial* shown_ = nullptr; ///< whose run is being shown
};

} // namespace moonshade::renderer
