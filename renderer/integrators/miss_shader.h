// What arrives from the surroundings along a batch of directions: sun, sky and images at once, shaders by one call
// each.
#pragma once

#include "renderer/integrators/task.h"
#include "renderer/prepared_scene.h"

namespace moonshade::renderer {

class MissShader {
public:
  MissShader(const PreparedScene& scene, size_t capacity);

  void add(uint32_t owner, const Vec3& direction, float spread) {
    owners_.push_back(owner);
    directions_.push_back(direction);
    spreads_.push_back(spread);
  }
  /// What arrives along one of the directions added.
  struct Arrival {
    uint32_t owner;
    Vec3 radiance;
    bool faulted;
    const Vec3& direction;
    const float* density; ///< by which a light sample finds it, the choice of the light included; null: not known yet
  };
  /// Calls visit(const Arrival&) in the order of adding, and is empty then.
  template <typename Visit> void shade(FaultLog& faults, WorkerStats& stats, Visit visit) {
    if (owners_.empty()) return;
    ask(faults, stats);
    for (size_t k = 0; k < owners_.size(); ++k)
      visit(Arrival{owners_[k], radiance_[k], batch_ && faulted_[k] != 0, directions_[k],
                    knows_density_ ? &density_[k] : nullptr});
    owners_.clear(), directions_.clear(), spreads_.clear();
  }

private:
  void ask(FaultLog& faults, WorkerStats& stats);

  const LightSet& lights_;
  std::vector<uint32_t> owners_;
  std::vector<Vec3> directions_, radiance_;
  std::vector<float> spreads_, density_;
  bool knows_density_;
  std::vector<uint8_t> faulted_, codes_;
  std::unique_ptr<ShadingBatch> batch_; ///< only where shaders are asked
};

} // namespace moonshade::renderer
