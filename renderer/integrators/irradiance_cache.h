// Indirect light for a quick preview: irradiance at places spread over what the camera sees, each gathered by rays over
// its hemisphere. What a ray meets counts as a diffuse surface of its shader's average colour (measured when the scene
// is loaded), lit directly, and from the second round on by the records of the round before. Nothing of it depends on
// threads: records are placed by the image's pixels alone.
#pragma once

#include "renderer/integrators/photon_map.h"
#include "renderer/integrators/shadow_tracer.h"

#include <tbb/task_arena.h>

namespace moonshade::renderer {

class IrradianceCache {
public:
  IrradianceCache(const PreparedScene& scene, tbb::task_arena& arena, WorkerStats& stats, FaultLog& faults);

  /// Indirect irradiance on a surface; `width` is that of the pixel's footprint there.
  Vec3 at(const Vec3& point, const Vec3& normal, float width) const;
  size_t size() const { return records_.size(); }

private:
  struct Place {
    Vec3 point{0}, normal{0};
    float offset = 0;
  };
  struct Worker;
  std::vector<Place> place_records() const;
  void gather(std::span<const Place> places, uint32_t first, uint32_t round, Worker& worker, Vec3* irradiance) const;
  void run_round(const std::vector<Place>& places, uint32_t round, tbb::task_arena& arena, VolumeControls& controls,
                 std::vector<std::unique_ptr<Worker>>& workers);

  const PreparedScene& scene_;
  std::vector<Vec3> colors_; ///< average, by object
  PhotonMap records_;        ///< of the round before; `power` is irradiance
  Vec3 mean_{0};
};

} // namespace moonshade::renderer
