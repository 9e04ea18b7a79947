// Hypertextures (Perlin and Hoffert 1989): objects whose material has a `density` are volumes. Their surfaces only
// bound them. Each has a grid of controls over its box: numbers near the density's maximum in a cell, measured from the
// compiled shader when the scene is loaded, and raised while rendering (VolumeControls). Tracking is unbiased for any
// positive controls (Galtier et al. 2013); near the maximum it is quick.
#pragma once

#include "renderer/geometry/geometry.h"
#include "renderer/materials/material_set.h"
#include "renderer/volumes/glow_grid.h"
#include "renderer/volumes/grid.h"
#include "renderer/volumes/media.h"

#include <memory>

namespace moonshade::renderer {

struct Volume {
  static constexpr float kSafety = 1.25f; ///< a control over the greatest density seen

  Vec3 low{0}, cell{1}; ///< in object space
  int size[3] = {1, 1, 1};
  std::vector<float> controls;
  std::unique_ptr<GlowGrid> glow; ///< null: emits nothing

  size_t index(const int* at) const { return cell_index(at, size); }
};

class VolumeSet {
public:
  VolumeSet(const Scene& scene, const Geometry& geometry, const MaterialSet& materials);

  bool any() const { return any_; }
  size_t object_count() const { return volumes_.size(); }
  /// Nothing but speed and noise depends on controls; for tests of that.
  void multiply_controls(float factor);
  /// The volume of an object; null: a surface.
  const Volume* of(uint32_t object) const { return volumes_[object].get(); }

private:
  std::vector<std::unique_ptr<Volume>> volumes_;
  bool any_ = false;
};

/// The volumes around a point: those left more often than entered on the way out.
Media media_at(const Geometry& geometry, const VolumeSet& volumes, const Vec3& point);

/// Inputs of a volume's shaders at one point, into the batch at `k`.
void fill_volume_inputs(ShadingBatch& batch, size_t k, const Vec3& local, const Vec3& world, const Vec3& direction,
                        float footprint, uint32_t object);

} // namespace moonshade::renderer
