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
  /// Calls visit(owner, radiance, faulted) in the order of adding, and is empty then.
  template <typename Visit> void shade(FaultLog& faults, WorkerStats& stats, Visit visit) {
    if (owners_.empty()) return;
    ask(faults, stats);
    for (size_t k = 0; k < owners_.size(); ++k)
      visit(owners_[k], radiance_[k], faulted_[k] != 0);
    owners_.clear(), directions_.clear(), spreads_.clear();
  }

private:
  void ask(FaultLog& faults, WorkerStats& stats);

  const LightSet& lights_;
  std::vector<uint32_t> owners_;
  std::vector<Vec3> directions_, radiance_;
  std::vector<float> spreads_;
  std::vector<uint8_t> faulted_, codes_;
  std::unique_ptr<ShadingBatch> batch_; ///< only where shaders are asked
};

} // namespace moonshade::renderer
