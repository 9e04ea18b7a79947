// Hits of a batch of rays, shaded: sorted by material, their points computed, and each material's shaders called once
// for all its points. Whoever traced the rays adds the hits and is then shown one material after the other.
#pragma once

#include "renderer/integrators/task.h"
#include "renderer/materials/bsdf.h"
#include "renderer/materials/material_set.h"

#include <ctime>
#include <vector>

namespace moonshade::renderer {

/// What this thread has run so far; waiting for a core does not count.
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

class HitShader {
public:
  /// All outlive this; `capacity` is the most hits at a time.
  HitShader(const Scene& scene, const Geometry& geometry, const MaterialSet& materials, size_t capacity);

  void clear() { added_.clear(); }
  /// The ray stays where it is until its hit has been shown. The footprint is `width` wide at its origin and grows by
  /// `spread` per distance.
  void add(uint32_t owner, const Ray& ray, const Hit& hit, float width, float spread) {
    added_.push_back({owner, width, spread, &ray, hit});
  }

  /// Shades everything added; calls visit(material, begin, end) for each material's points [begin, end).
  template <typename Visit> void shade(FaultLog& faults, WorkerStats& stats, Visit visit) {
    sort();
    for (uint32_t material = 0; material < materials_.size(); ++material) {
      size_t begin = run_start_[material], end = run_start_[material + 1];
      if (begin == end) continue;
      shade_run(materials_[material], begin, end, faults, stats);
      visit(materials_[material], begin, end);
    }
  }

  uint32_t owner(size_t k) const { return met_[k].owner; }
  const Hit& hit(size_t k) const { return met_[k].hit; }
  const Ray& ray(size_t k) const { return *met_[k].ray; }
  /// Of the footprint at the point, in world units.
  float width(size_t k) const { return met_[k].width; }
  /// Both normals turned to the viewer.
  const SurfacePoint& point(size_t k) const { return points_[k]; }
  bool backface(size_t k) const { return batch_.backface[k]; }
  bool faulted(size_t k) const { return batch_.faulted[k]; }
  SurfaceValues values(size_t k) const;
  Bsdf bsdf(const CompiledMaterial& material, size_t k, const SurfaceValues& values, bool photons = false) const {
    return Bsdf(values, points_[k].shading_normal, points_[k].geometric_normal, -ray(k).direction,
                {bool(batch_.backface[k]), material.thin, photons});
  }
  /// Share of light that passes straight on.
  Vec3 straight_through(const CompiledMaterial& material, size_t k) const;

private:
  struct Met {
    uint32_t owner;
    float width, spread;
    const Ray* ray;
    Hit hit;
  };
  void sort();
  void shade_run(const CompiledMaterial& material, size_t begin, size_t end, FaultLog& faults, WorkerStats& stats);
  void fill_inputs(uint32_t needs, size_t k);
  void fill_normal(size_t k);

  const Geometry& geometry_;
  const MaterialSet& materials_;
  ShadingBatch batch_;
  std::vector<Met> added_, met_; ///< as added; sorted by material, within which they keep their order
  std::vector<uint32_t> material_, run_start_;
  std::vector<SurfacePoint> points_;
  std::vector<BumpTarget> targets_;
};

} // namespace moonshade::renderer
